#include "detect/depth_scene.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

#include "camera/depth_noise.h"
#include "detect/depth_grid.h"

namespace cpslam::scene {
namespace {

constexpr float kFarthest = std::numeric_limits<float>::infinity();

// Each gives the parameter of the first place along from + t * along, t > 0, that lies on the body.

float meet(const Plane& plane, const Eigen::Vector3f& from, const Eigen::Vector3f& along) {
  const float approach = plane.normal.dot(along);
  if (std::abs(approach) < 1e-6F) return kFarthest;
  const float t = (plane.offset_m - plane.normal.dot(from)) / approach;
  return t > 0.0F ? t : kFarthest;
}

float meet(const Block& block, const Eigen::Vector3f& from, const Eigen::Vector3f& along) {
  float enter = 0.0F;
  float leave = kFarthest;
  for (int axis = 0; axis < 3; ++axis) {
    if (along[axis] == 0.0F) {
      if (from[axis] < block.least[axis] || from[axis] > block.most[axis]) return kFarthest;
      continue;
    }
    const float a = (block.least[axis] - from[axis]) / along[axis];
    const float b = (block.most[axis] - from[axis]) / along[axis];
    enter = std::max(enter, std::min(a, b));
    leave = std::min(leave, std::max(a, b));
  }
  return enter > 0.0F && enter <= leave ? enter : kFarthest;
}

float meet(const Ellipsoid& body, const Eigen::Vector3f& from, const Eigen::Vector3f& along) {
  const Eigen::Vector3f o = (from - body.centre).cwiseQuotient(body.radii);
  const Eigen::Vector3f d = along.cwiseQuotient(body.radii);
  const float a = d.squaredNorm();
  const float b = o.dot(d);
  const float root = b * b - a * (o.squaredNorm() - 1.0F);
  if (root < 0.0F) return kFarthest;
  const float t = (-b - std::sqrt(root)) / a;
  return t > 0.0F ? t : kFarthest;
}

}  // namespace

std::vector<Ellipsoid> Person::limbs(double time_s) const {
  const Eigen::Vector3f at = feet + static_cast<float>(time_s) * velocity_m_per_s;
  const auto above = [&at](float x, float height) {
    return Eigen::Vector3f(at + Eigen::Vector3f(x, -height, 0));
  };
  return {{above(0.0F, 1.62F), {0.11F, 0.14F, 0.11F}},
          {above(0.0F, 1.15F), {0.25F, 0.40F, 0.15F}},
          {above(-0.12F, 0.43F), {0.09F, 0.43F, 0.10F}},
          {above(0.12F, 0.43F), {0.09F, 0.43F, 0.10F}}};
}

DepthScene& DepthScene::wall(float z_m) {
  return plane({{0.0F, 0.0F, 1.0F}, z_m});
}

DepthScene& DepthScene::floor() {
  return plane({{0.0F, 1.0F, 0.0F}, kCameraHeightM});
}

DepthScene& DepthScene::plane(const Plane& plane) {
  planes_.push_back(plane);
  return *this;
}

DepthScene& DepthScene::block(const Eigen::Vector3f& least, const Eigen::Vector3f& most) {
  blocks_.push_back({least, most});
  return *this;
}

DepthScene& DepthScene::person(const Person& person) {
  people_.push_back(person);
  return *this;
}

struct DepthScene::Hit {
  float t = kFarthest;
  std::uint8_t owner = 0;
};

DepthScene::Hit DepthScene::cast(const Eigen::Vector3f& from, const Eigen::Vector3f& along,
                                 const std::vector<std::pair<Ellipsoid, std::uint8_t>>& limbs) const {
  Hit hit;
  for (const Plane& plane : planes_) hit.t = std::min(hit.t, meet(plane, from, along));
  for (const Block& block : blocks_) hit.t = std::min(hit.t, meet(block, from, along));
  for (const auto& [limb, number] : limbs) {
    if (const float t = meet(limb, from, along); t < hit.t) hit = {t, number};
  }
  return hit;
}

std::vector<std::pair<Ellipsoid, std::uint8_t>> DepthScene::limbs_at(double time_s) const {
  std::vector<std::pair<Ellipsoid, std::uint8_t>> limbs;
  for (const Person& person : people_) {
    for (const Ellipsoid& limb : person.limbs(time_s)) limbs.emplace_back(limb, person.number);
  }
  return limbs;
}

View DepthScene::look(const GridCamera& camera, const SE3& world_from_camera, double time_s) const {
  View view{cv::Mat1f(camera.size(), 0.0F), cv::Mat1b(camera.size(), std::uint8_t{0})};
  const FloatTransform pose(world_from_camera);
  const auto limbs = limbs_at(time_s);
  for (int cell = 0; cell < camera.n_cells(); ++cell) {
    // The ray's z is 1 in the camera, so that its parameter is the depth.
    const Hit hit = cast(pose.translation, pose.rotation * camera.point(cell, 1.0F), limbs);
    if (!std::isfinite(hit.t)) continue;
    view.depth_m(cell) = hit.t;
    view.owner(cell) = hit.owner;
  }
  return view;
}

View DepthScene::look_close(const PinholeCamera& camera, const SE3& world_from_camera, double time_s) const {
  const cv::Size size(camera.width(), camera.height());
  View view{cv::Mat1f(size, 0.0F), cv::Mat1b(size, std::uint8_t{0})};
  const FloatTransform pose(world_from_camera);
  const auto limbs = limbs_at(time_s);
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) {
      const Eigen::Vector3f ray = camera.back_project({double(x), double(y)}, 1.0).cast<float>();
      const Hit hit = cast(pose.translation, pose.rotation * ray, limbs);
      if (!std::isfinite(hit.t)) continue;
      view.depth_m(y, x) = hit.t;
      view.owner(y, x) = hit.owner;
    }
  }
  return view;
}

CameraSettings camera_settings() {
  CameraSettings settings;
  settings.fx = 535.4;
  settings.fy = 539.2;
  settings.cx = 320.1;
  settings.cy = 247.6;
  settings.depth_map_factor = kUnitsPerM;
  return settings;
}

GridCamera grid_camera() {
  return GridCamera(PinholeCamera(camera_settings()));
}

void add_noise(View& view, Random& random) {
  for (float& depth_m : view.depth_m) {
    if (depth_m > 0.0F) depth_m += float(structured_light_sigma_m(double(depth_m)) * random.normal());
  }
}

cv::Mat raw_depth(const View& close_view) {
  cv::Mat raw;
  close_view.depth_m.convertTo(raw, CV_16UC1, kUnitsPerM);
  return raw;
}

std::vector<int> cells_of(const View& view, std::uint8_t number) {
  std::vector<int> cells;
  for (int cell = 0; cell < static_cast<int>(view.owner.total()); ++cell) {
    if (view.owner(cell) == number) cells.push_back(cell);
  }
  return cells;
}

PersonBox box_of(const View& view, std::uint8_t number) {
  std::vector<cv::Point> places;
  cv::findNonZero(view.owner == number, places);
  if (places.empty()) return {};
  int left = view.owner.cols, top = view.owner.rows, right = -1, bottom = -1;
  for (const cv::Point& at : places) {
    left = std::min(left, at.x);
    right = std::max(right, at.x);
    top = std::min(top, at.y);
    bottom = std::max(bottom, at.y);
  }
  const double px = kDepthCellPx;
  return {left * px, top * px, (right - left + 1) * px, (bottom - top + 1) * px, 0.9};
}

double overlap(std::vector<int> a, std::vector<int> b) {
  std::sort(a.begin(), a.end());
  std::sort(b.begin(), b.end());
  std::vector<int> common;
  std::set_intersection(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(common));
  const std::size_t all = a.size() + b.size() - common.size();
  return all == 0 ? 1.0 : double(common.size()) / double(all);
}

PersonTrack track_of(const View& view, std::uint8_t number, double time_s) {
  PersonTrack track;
  track.number = number;
  for (const int cell : cells_of(view, number)) track.visible.add(cell, view.depth_m(cell));
  track.shape = track.visible;
  track.box = box_of(view, number);
  track.confirmed_s = time_s;
  track.seen_s = time_s;
  track.confirmations = 5;
  return track;
}

std::vector<DepthKeypoint> keypoints_on(const View& view, int step) {
  std::vector<DepthKeypoint> keypoints;
  const auto middle = [](int cell) { return (float(cell) + 0.5F) * float(kDepthCellPx) - 0.5F; };
  for (int y = step / 2; y < view.depth_m.rows; y += step) {
    for (int x = step / 2; x < view.depth_m.cols; x += step)
      keypoints.push_back({middle(x), middle(y), view.depth_m(y, x)});
  }
  return keypoints;
}

cv::Mat1b blank(const View& view, std::uint8_t value) {
  return cv::Mat1b(view.depth_m.size(), value);
}

SE3 world_from_camera_at(double x_m, double y_m, double z_m, double yaw_rad) {
  return {so3_exp({0.0, yaw_rad, 0.0}), {x_m, y_m, z_m}};
}

}  // namespace cpslam::scene
