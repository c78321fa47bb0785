#include "sim/simulation.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "cpslam/error.h"
#include "sim/house.h"
#include "sim/person.h"
#include "sim/sensor.h"

namespace cpslam::sim {
namespace {

constexpr double kFirstStamp_s = 1000.0;
constexpr double kExposure_s = 0.02;
constexpr int kBlurSteps = 6;
constexpr double kSmallestVisibleShare = 0.02;

enum Stream : std::uint64_t { kScene = 1, kPath, kPeople, kDrift, kNoise };

// Independent generators, so that people or noise never change room and path.
Random stream(std::uint64_t seed, Stream which, std::uint64_t index = 0) {
  Random mixer(seed ^ (static_cast<std::uint64_t>(which) << 56U));
  Random second(mixer.next() + index);
  return Random(second.next());
}

}  // namespace

CameraSettings SimulationOptions::default_camera() {
  CameraSettings camera;
  camera.fx = 535.4;
  camera.fy = 539.2;
  camera.cx = 320.1;
  camera.cy = 247.6;
  return camera;
}

void SimulationOptions::check() const {
  static_cast<void>(find_preset(preset));
  if (n_frames && *n_frames < 1)
    throw InputError("frames: must be at least 1, not " + std::to_string(*n_frames));
  if (n_people && (*n_people < 0 || *n_people > kMaxPeople))
    throw InputError("people: must lie in 0 to " + std::to_string(kMaxPeople) + ", not " +
                     std::to_string(*n_people));
  if (n_threads < 1) throw InputError("threads: must be at least 1, not " + std::to_string(n_threads));
  if (!std::isfinite(start_s) || start_s < 0.0) throw InputError("start: must be a time of at least 0 s");
  if (camera.width < 1 || camera.height < 1 || !(camera.fx > 0.0) || !(camera.fy > 0.0) ||
      !(camera.fps > 0.0) || !(camera.bf > 0.0))
    throw InputError("camera: width, height, fx, fy, fps and bf must be positive");
}

std::vector<PersonBox> SimulatedFrame::boxes() const {
  std::vector<PersonBox> all;
  for (const SimulatedPerson& person : people) all.push_back(person.box);
  return all;
}

struct Simulation::Impl {
  SimulationOptions options;
  PresetInfo preset;
  int n_frames;
  Scene scene;
  std::unique_ptr<CameraPath> path;
  std::vector<Person> people;
  std::vector<SceneObject> bodies;
  std::vector<const SceneObject*> objects;
  Rasterizer rasterizer;
  PinholeCamera pinhole;
  double drift_phase;

  explicit Impl(const SimulationOptions& o)
      : options(o),
        preset(find_preset(o.preset)),
        n_frames(o.n_frames.value_or(preset.n_frames)),
        rasterizer(o.camera, o.n_threads),
        pinhole(o.camera) {
    Random scene_random = stream(o.seed, kScene);
    scene = build_scene(preset, scene_random);
    Random path_random = stream(o.seed, kPath);
    path = make_camera_path(preset.path, path_random);
    Random drift_random = stream(o.seed, kDrift);
    drift_phase = drift_random.uniform(0.0, 2.0 * std::numbers::pi);
    const int n_people = o.n_people.value_or(preset.n_people);
    for (int id = 0; id < n_people; ++id) {
      Random random = stream(o.seed, kPeople, static_cast<std::uint64_t>(id));
      std::unique_ptr<PersonScript> script = make_person_script(preset, id, random);
      people.emplace_back(id, std::move(script), scene.assets, random);
    }
    bodies.resize(people.size());
    for (const SceneObject& object : scene.objects) objects.push_back(&object);
    for (const SceneObject& body : bodies) objects.push_back(&body);
  }

  [[nodiscard]] double path_time(int index) const { return options.start_s + index / options.camera.fps; }
  void draw(double time_s, RenderedView& view) {
    for (std::size_t i = 0; i < people.size(); ++i) people[i].pose_at(time_s, scene.lighting, bodies[i]);
    rasterizer.render(objects, scene.assets, path->world_from_camera(time_s), view);
  }
  void blur(double time_s, RenderedView& view) {
    RenderedView moment;
    cv::Mat sum = cv::Mat::zeros(view.colour_bgr.size(), CV_32FC3);
    for (int i = 0; i < kBlurSteps; ++i) {
      draw(time_s + kExposure_s * ((i + 0.5) / kBlurSteps - 0.5), moment);
      sum += cv::min(moment.colour_bgr, cv::Scalar::all(255.0));
    }
    view.colour_bgr = sum / static_cast<double>(kBlurSteps);
  }
  [[nodiscard]] double gain(double time_s) const {
    if (!options.exposure_drift) return 1.0;
    return 1.0 + 0.17 * std::sin(0.9 * time_s + drift_phase) +
           0.08 * std::sin(2.3 * time_s + 2.0 * drift_phase);
  }
  [[nodiscard]] std::vector<SimulatedPerson> seen_people(const cv::Mat& mask,
                                                         const SE3& camera_from_world) const;
};

std::vector<SimulatedPerson> Simulation::Impl::seen_people(const cv::Mat& mask,
                                                           const SE3& camera_from_world) const {
  struct Extent {
    int n = 0;
    int left = 0, right = 0, top = 0, bottom = 0;
  };
  std::vector<Extent> extents(people.size());
  for (int y = 0; y < mask.rows; ++y) {
    const auto* row = mask.ptr<std::uint8_t>(y);
    for (int x = 0; x < mask.cols; ++x) {
      if (row[x] == 0) continue;
      Extent& e = extents[static_cast<std::size_t>(row[x]) - 1];
      if (e.n++ == 0) e = {1, x, x, y, y};
      e.left = std::min(e.left, x);
      e.right = std::max(e.right, x);
      e.bottom = y;
    }
  }
  const cv::Rect2d image(0, 0, mask.cols, mask.rows);
  std::vector<SimulatedPerson> seen;
  for (std::size_t i = 0; i < people.size(); ++i) {
    const Extent& e = extents[i];
    if (e.n == 0) continue;
    Eigen::AlignedBox2d whole;
    for (const Vertex& vertex : bodies[i].mesh_in_world.vertices) {
      const Eigen::Vector3d point = camera_from_world * vertex.position.cast<double>();
      if (point.z() > 0.05) whole.extend(pinhole.distort(pinhole.project(point)));
    }
    const cv::Rect2d whole_box(whole.min().x(), whole.min().y(), whole.sizes().x(), whole.sizes().y());
    const double share = e.n / std::max(1.0, (whole_box & image).area());
    if (share < kSmallestVisibleShare) continue;
    SimulatedPerson person;
    person.id = static_cast<int>(i);
    person.box = {static_cast<double>(e.left), static_cast<double>(e.top), e.right - e.left + 1.0,
                  e.bottom - e.top + 1.0, 1.0};
    person.visible_share = std::min(1.0, share);
    seen.push_back(person);
  }
  return seen;
}

Simulation::Simulation(const SimulationOptions& options) {
  options.check();
  impl_ = std::make_unique<Impl>(options);
}
Simulation::~Simulation() = default;
Simulation::Simulation(Simulation&&) noexcept = default;
Simulation& Simulation::operator=(Simulation&&) noexcept = default;

const SimulationOptions& Simulation::options() const {
  return impl_->options;
}
const PresetInfo& Simulation::preset() const {
  return impl_->preset;
}
const CameraSettings& Simulation::camera() const {
  return impl_->options.camera;
}
int Simulation::size() const {
  return impl_->n_frames;
}
int Simulation::n_people() const {
  return static_cast<int>(impl_->people.size());
}
const std::vector<Eigen::AlignedBox3f>& Simulation::rooms() const {
  return impl_->scene.rooms;
}
const std::vector<Eigen::AlignedBox3f>& Simulation::obstacles() const {
  return impl_->scene.obstacles;
}

Settings Simulation::settings() const {
  Settings settings;
  settings.camera = camera();
  return settings;
}

double Simulation::time_s(int index) const {
  return kFirstStamp_s + impl_->path_time(index);
}

SE3 Simulation::world_from_camera(int index) const {
  return impl_->path->world_from_camera(impl_->path_time(index));
}

Trajectory Simulation::ground_truth() const {
  Trajectory trajectory;
  for (int i = 0; i < size(); ++i) trajectory.push_back({time_s(i), to_pose(world_from_camera(i))});
  return trajectory;
}

std::vector<Eigen::Vector3d> Simulation::person_joints(int person, int index) const {
  const Joints joints = impl_->people.at(static_cast<std::size_t>(person)).joints(impl_->path_time(index));
  return {joints.begin(), joints.end()};
}

SimulatedFrame Simulation::render(int index) {
  if (index < 0 || index >= size())
    throw InputError("frame " + std::to_string(index) + " of a simulation of " + std::to_string(size()));
  const double time = impl_->path_time(index);
  RenderedView view;
  impl_->draw(time, view);
  SimulatedFrame frame;
  frame.time_s = time_s(index);
  frame.world_from_camera = world_from_camera(index);
  frame.person_mask = view.label;
  frame.people = impl_->seen_people(view.label, frame.world_from_camera.inverse());
  if (impl_->options.motion_blur) impl_->blur(time, view);
  const SimulationOptions& options = impl_->options;
  Random noise = stream(options.noise_seed.value_or(options.seed), kNoise, static_cast<std::uint64_t>(index));
  frame.depth = options.sensor_noise ? structured_light_depth(view, options.camera, noise)
                                     : exact_depth(view.depth_m, options.camera.depth_map_factor);
  frame.colour_bgr = develop_colour(view.colour_bgr, impl_->gain(time), options.sensor_noise, noise);
  return frame;
}

}  // namespace cpslam::sim
