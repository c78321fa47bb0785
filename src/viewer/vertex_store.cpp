#include "viewer/vertex_store.h"

#include <epoxy/gl.h>

#include <cstdint>

namespace cpslam::viewer {
namespace {

const void* offset(std::size_t bytes) {
  return reinterpret_cast<const void*>(static_cast<std::uintptr_t>(bytes));  // NOLINT: OpenGL's convention
}

/// Position and colour of a Vertex that lies `start` bytes into elements of this size.
void describe_vertex(GLuint first_attribute, std::size_t element_bytes, std::size_t start, GLuint divisor) {
  const auto stride = static_cast<GLsizei>(element_bytes);
  glEnableVertexAttribArray(first_attribute);
  glVertexAttribPointer(first_attribute, 3, GL_FLOAT, GL_FALSE, stride,
                        offset(start + offsetof(Vertex, position)));
  glVertexAttribDivisor(first_attribute, divisor);
  glEnableVertexAttribArray(first_attribute + 1);
  glVertexAttribPointer(first_attribute + 1, 4, GL_UNSIGNED_BYTE, GL_TRUE, stride,
                        offset(start + offsetof(Vertex, colour)));
  glVertexAttribDivisor(first_attribute + 1, divisor);
}

void fill(GLuint buffer, const void* data, std::size_t bytes) {
  glBindBuffer(GL_ARRAY_BUFFER, buffer);
  glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(bytes), data, GL_DYNAMIC_DRAW);
}

}  // namespace

PointStore::PointStore() {
  glGenVertexArrays(1, &array_);
  glGenBuffers(1, &buffer_);
  glBindVertexArray(array_);
  glBindBuffer(GL_ARRAY_BUFFER, buffer_);
  describe_vertex(0, sizeof(Vertex), 0, 0);
}

PointStore::~PointStore() {
  glDeleteBuffers(1, &buffer_);
  glDeleteVertexArrays(1, &array_);
}

void PointStore::set(const std::vector<Vertex>& vertices) {
  count_ = vertices.size();
  fill(buffer_, vertices.data(), vertices.size() * sizeof(Vertex));
}

void PointStore::draw() const {
  if (count_ == 0) return;
  glBindVertexArray(array_);
  glDrawArrays(GL_POINTS, 0, static_cast<GLsizei>(count_));
}

SegmentStore::SegmentStore() {
  glGenVertexArrays(1, &array_);
  glGenBuffers(1, &buffer_);
  glBindVertexArray(array_);
  glBindBuffer(GL_ARRAY_BUFFER, buffer_);
  describe_vertex(0, sizeof(Segment), offsetof(Segment, from), 1);
  describe_vertex(2, sizeof(Segment), offsetof(Segment, to), 1);
}

SegmentStore::~SegmentStore() {
  glDeleteBuffers(1, &buffer_);
  glDeleteVertexArrays(1, &array_);
}

void SegmentStore::set(const std::vector<Segment>& segments) {
  count_ = segments.size();
  fill(buffer_, segments.data(), segments.size() * sizeof(Segment));
}

void SegmentStore::draw() const {
  if (count_ == 0) return;
  glBindVertexArray(array_);
  glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, static_cast<GLsizei>(count_));
}

}  // namespace cpslam::viewer
