#include "viewer/offscreen_picture.h"

#include <epoxy/gl.h>

#include "cpslam/error.h"
#include "viewer/widgets.h"

namespace cpslam::viewer {

OffscreenPicture::OffscreenPicture() {
  glGenFramebuffers(1, &frame_);
  glGenRenderbuffers(1, &colour_);
  glGenRenderbuffers(1, &depth_);
}

OffscreenPicture::~OffscreenPicture() {
  glDeleteRenderbuffers(1, &depth_);
  glDeleteRenderbuffers(1, &colour_);
  glDeleteFramebuffers(1, &frame_);
}

void OffscreenPicture::begin(cv::Size size) {
  glBindFramebuffer(GL_FRAMEBUFFER, frame_);
  if (size != size_) resize(size);
}

void OffscreenPicture::resize(cv::Size size) {
  const auto give_memory = [&](GLuint buffer, GLenum format, GLenum part) {
    glBindRenderbuffer(GL_RENDERBUFFER, buffer);
    glRenderbufferStorage(GL_RENDERBUFFER, format, size.width, size.height);
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, part, GL_RENDERBUFFER, buffer);
  };
  give_memory(colour_, GL_RGBA8, GL_COLOR_ATTACHMENT0);
  give_memory(depth_, GL_DEPTH_COMPONENT24, GL_DEPTH_ATTACHMENT);
  if (glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE) {
    throw RunError(
        text("the viewer: OpenGL refuses an off-screen picture of %d x %d px", size.width, size.height));
  }
  size_ = size;
}

void OffscreenPicture::end() const {
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
}

void OffscreenPicture::show(cv::Point corner) const {
  glBindFramebuffer(GL_READ_FRAMEBUFFER, frame_);
  glBlitFramebuffer(0, 0, size_.width, size_.height, corner.x, corner.y, corner.x + size_.width,
                    corner.y + size_.height, GL_COLOR_BUFFER_BIT, GL_NEAREST);
  glBindFramebuffer(GL_READ_FRAMEBUFFER, 0);
}

}  // namespace cpslam::viewer
