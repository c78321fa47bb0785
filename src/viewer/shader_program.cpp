#include "viewer/shader_program.h"

#include <epoxy/gl.h>

#include "cpslam/error.h"

namespace cpslam::viewer {
namespace {

/// A shader that is only needed until the program is linked.
class Shader {
 public:
  Shader(GLenum kind, const std::string& source) : id_(glCreateShader(kind)) {
    const char* const text = source.c_str();
    glShaderSource(id_, 1, &text, nullptr);
    glCompileShader(id_);
    GLint compiled = GL_FALSE;
    glGetShaderiv(id_, GL_COMPILE_STATUS, &compiled);
    if (compiled == GL_TRUE) return;
    const std::string problem = message();
    glDeleteShader(id_);
    throw RunError("the graphics driver refuses a shader of the viewer: " + problem);
  }
  ~Shader() { glDeleteShader(id_); }
  Shader(const Shader&) = delete;
  Shader& operator=(const Shader&) = delete;
  [[nodiscard]] GLuint id() const { return id_; }

 private:
  [[nodiscard]] std::string message() const {
    GLint length = 0;
    glGetShaderiv(id_, GL_INFO_LOG_LENGTH, &length);
    std::string text(static_cast<std::size_t>(length > 0 ? length : 1), '\0');
    glGetShaderInfoLog(id_, static_cast<GLsizei>(text.size()), nullptr, text.data());
    return text.substr(0, text.find('\n'));
  }
  GLuint id_;
};

}  // namespace

ShaderProgram::ShaderProgram(const std::string& vertex_source, const std::string& fragment_source) {
  const Shader vertex(GL_VERTEX_SHADER, vertex_source);
  const Shader fragment(GL_FRAGMENT_SHADER, fragment_source);
  id_ = glCreateProgram();
  glAttachShader(id_, vertex.id());
  glAttachShader(id_, fragment.id());
  glLinkProgram(id_);
  glDetachShader(id_, vertex.id());
  glDetachShader(id_, fragment.id());
  GLint linked = GL_FALSE;
  glGetProgramiv(id_, GL_LINK_STATUS, &linked);
  if (linked == GL_TRUE) return;
  glDeleteProgram(id_);
  throw RunError("the graphics driver cannot link the shaders of the viewer");
}

ShaderProgram::~ShaderProgram() {
  glDeleteProgram(id_);
}

void ShaderProgram::use() const {
  glUseProgram(id_);
}

int ShaderProgram::location(const char* uniform) const {
  return glGetUniformLocation(id_, uniform);
}

void ShaderProgram::set(const char* uniform, float value) const {
  glUniform1f(location(uniform), value);
}

void ShaderProgram::set(const char* uniform, const Eigen::Vector2f& value) const {
  glUniform2fv(location(uniform), 1, value.data());
}

void ShaderProgram::set(const char* uniform, const Eigen::Vector3f& value) const {
  glUniform3fv(location(uniform), 1, value.data());
}

void ShaderProgram::set(const char* uniform, const Eigen::Matrix4f& value) const {
  glUniformMatrix4fv(location(uniform), 1, GL_FALSE, value.data());
}

}  // namespace cpslam::viewer
