#pragma once

namespace cpslam::viewer {

/// Points, a pixel size each that shrinks with the distance, fading into the background.
inline constexpr const char* kPointVertexShader = R"(#version 330 core
layout(location = 0) in vec3 position;
layout(location = 1) in vec4 colour;
uniform mat4 eye_from_world;
uniform mat4 clip_from_eye;
uniform float focal_px;
uniform float size_m;
uniform float least_px;
uniform float most_px;
uniform float fade_from_m;
uniform vec3 background;
out vec4 shown;
void main() {
  vec4 in_eye = eye_from_world * vec4(position, 1.0);
  float distance_m = max(-in_eye.z, 1e-3);
  gl_Position = clip_from_eye * in_eye;
  gl_PointSize = clamp(focal_px * size_m / distance_m, least_px, most_px);
  float fade = 1.0 - exp(-0.5 * max(distance_m / fade_from_m - 1.0, 0.0));
  shown = vec4(mix(colour.rgb, background, 0.75 * fade), colour.a);
}
)";

/// Square ones: for many small points, since what a software renderer has to throw away costs it most.
inline constexpr const char* kSquareFragmentShader = R"(#version 330 core
in vec4 shown;
out vec4 pixel;
void main() {
  pixel = shown;
}
)";

/// Round ones.
inline constexpr const char* kRoundFragmentShader = R"(#version 330 core
in vec4 shown;
out vec4 pixel;
void main() {
  vec2 off = 2.0 * gl_PointCoord - 1.0;
  float rim = dot(off, off);
  if (rim > 1.0) discard;
  pixel = vec4(shown.rgb * (1.0 - 0.3 * rim), shown.a);  // as of little balls
}
)";

/// Lines of any width with soft rims: core OpenGL has only hard ones of a pixel. A quad per line, made from
/// its two ends, which are first cut off in front of the eye.
inline constexpr const char* kLineVertexShader = R"(#version 330 core
layout(location = 0) in vec3 from;
layout(location = 1) in vec4 from_colour;
layout(location = 2) in vec3 to;
layout(location = 3) in vec4 to_colour;
uniform mat4 clip_from_world;
uniform vec2 viewport_px;
uniform float width_px;
out vec4 shown;
out float across_px;
const float kNearest = 0.01;
void main() {
  vec4 a = clip_from_world * vec4(from, 1.0);
  vec4 b = clip_from_world * vec4(to, 1.0);
  if (a.w < kNearest && b.w < kNearest) {
    gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
    return;
  }
  if (a.w < kNearest) a = mix(a, b, (kNearest - a.w) / (b.w - a.w));
  if (b.w < kNearest) b = mix(b, a, (kNearest - b.w) / (a.w - b.w));
  vec2 along = (b.xy / b.w - a.xy / a.w) * viewport_px;
  float length_px = length(along);
  along = length_px > 1e-6 ? along / length_px : vec2(1.0, 0.0);
  float side = (gl_VertexID & 1) == 0 ? -1.0 : 1.0;
  bool at_from = gl_VertexID < 2;
  vec4 end = at_from ? a : b;
  float reach_px = 0.5 * width_px + 1.0;
  vec2 off = vec2(-along.y, along.x) * side * reach_px * 2.0 / viewport_px;
  gl_Position = vec4(end.xy + off * end.w, end.zw);
  across_px = side * reach_px;
  shown = at_from ? from_colour : to_colour;
}
)";

inline constexpr const char* kLineFragmentShader = R"(#version 330 core
in vec4 shown;
in float across_px;
uniform float width_px;
out vec4 pixel;
void main() {
  float cover = clamp(0.5 * width_px + 0.5 - abs(across_px), 0.0, 1.0);
  pixel = vec4(shown.rgb, shown.a * cover);
}
)";

}  // namespace cpslam::viewer
