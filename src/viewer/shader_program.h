#pragma once

#include <Eigen/Core>
#include <string>

namespace cpslam::viewer {

/// A vertex and a fragment shader, linked. Lives in the thread of its OpenGL context.
class ShaderProgram {
 public:
  /// GLSL 3.30 sources. Throws RunError with the driver's message.
  ShaderProgram(const std::string& vertex_source, const std::string& fragment_source);
  ~ShaderProgram();
  ShaderProgram(const ShaderProgram&) = delete;
  ShaderProgram& operator=(const ShaderProgram&) = delete;

  /// The set() calls are about the program in use.
  void use() const;
  void set(const char* uniform, float value) const;
  void set(const char* uniform, const Eigen::Vector2f& value) const;
  void set(const char* uniform, const Eigen::Vector3f& value) const;
  void set(const char* uniform, const Eigen::Matrix4f& value) const;

 private:
  [[nodiscard]] int location(const char* uniform) const;
  unsigned id_ = 0;
};

}  // namespace cpslam::viewer
