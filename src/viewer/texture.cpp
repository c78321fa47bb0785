#include "viewer/texture.h"

#include <epoxy/gl.h>

#include <array>
#include <cstdint>

namespace cpslam::viewer {
namespace {

struct Format {
  GLint stored;
  GLenum given;
};

Format format_of(const cv::Mat& picture) {
  if (picture.type() == CV_8UC1) return {GL_R8, GL_RED};
  if (picture.type() == CV_8UC3) return {GL_RGB8, GL_BGR};
  return {GL_RGBA8, GL_RGBA};
}

}  // namespace

Texture::Texture() {
  glGenTextures(1, &id_);
}

Texture::~Texture() {
  glDeleteTextures(1, &id_);
}

void Texture::set(const cv::Mat& picture) {
  size_ = picture.size();
  if (empty()) return;
  const cv::Mat rows = picture.isContinuous() ? picture : picture.clone();
  const Format format = format_of(rows);
  glBindTexture(GL_TEXTURE_2D, id_);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  const std::array<GLint, 4> grey{GL_RED, GL_RED, GL_RED, GL_ONE};
  const std::array<GLint, 4> as_it_is{GL_RED, GL_GREEN, GL_BLUE, GL_ALPHA};
  const bool one_channel = rows.channels() == 1;
  glTexParameteriv(GL_TEXTURE_2D, GL_TEXTURE_SWIZZLE_RGBA, one_channel ? grey.data() : as_it_is.data());
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  glTexImage2D(GL_TEXTURE_2D, 0, format.stored, rows.cols, rows.rows, 0, format.given, GL_UNSIGNED_BYTE,
               rows.data);
}

void* Texture::handle() const {
  return reinterpret_cast<void*>(static_cast<std::uintptr_t>(id_));  // NOLINT: ImGui's convention
}

}  // namespace cpslam::viewer
