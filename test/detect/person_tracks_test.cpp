#include "detect/person_tracks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <limits>

#include "detect/depth_scene.h"
#include "support/synthetic.h"

namespace cpslam {
namespace {

using scene::DepthScene;
using scene::kCameraHeightM;
using scene::Person;
using scene::View;

constexpr double kStepS = 1.0 / 30.0;
constexpr double kBeginS = 1000.0;

/// Frames of a scene, rendered once, and runs of PersonTracks through them.
struct Film {
  using CameraPath = std::function<SE3(double time_s)>;
  explicit Film(
      const DepthScene& room, int n_frames, const CameraPath& path = [](double) { return SE3(); }) {
    const GridCamera camera = scene::grid_camera();
    Random random(7);
    for (int i = 0; i < n_frames; ++i) {
      views.push_back(room.look(camera, path(i * kStepS), i * kStepS));
      boxes.push_back(boxes_of(views.back()));
      scene::add_noise(views.back(), random);
      moved.push_back(path(i * kStepS).inverse() * path(std::max(0, i - 1) * kStepS));
    }
  }
  static std::vector<PersonBox> boxes_of(const View& view) {
    std::vector<PersonBox> boxes;
    for (const std::uint8_t number : {std::uint8_t{1}, std::uint8_t{2}}) {
      if (scene::cells_of(view, number).size() > 80) boxes.push_back(scene::box_of(view, number));
    }
    return boxes;
  }
  [[nodiscard]] int size() const { return int(views.size()); }
  [[nodiscard]] static double time_s(int i) { return kBeginS + i * kStepS; }
  [[nodiscard]] Detections detections(int i) const {
    return {std::uint64_t(i), time_s(i), boxes[std::size_t(i)]};
  }
  void begin(PersonTracks& tracks, int i) const {
    tracks.begin_frame(std::uint64_t(i), time_s(i), views[std::size_t(i)].depth_m, moved[std::size_t(i)]);
  }
  void end(PersonTracks& tracks, int i) const { tracks.end_frame(moved[std::size_t(i)], true); }
  /// Intersection over union of all people.
  [[nodiscard]] double iou(const PersonTracks& tracks, int i) const {
    const cv::Mat found = tracks.labels() != 0, truth = views[std::size_t(i)].owner != 0;
    const int all = cv::countNonZero(found | truth);
    return all == 0 ? 1.0 : double(cv::countNonZero(found & truth)) / double(all);
  }

  std::vector<View> views;
  std::vector<std::vector<PersonBox>> boxes;
  std::vector<SE3> moved;
};

PersonTracks new_tracks(std::uint64_t seed = 0) {
  return {PinholeCamera(scene::camera_settings()), seed};
}

DepthScene room() {
  return DepthScene().wall(4.5F).floor().block({0.9F, 0.4F, 2.2F}, {1.8F, 1.2F, 2.8F});
}

Person walker() {
  return {1, {-0.6F, kCameraHeightM, 2.7F}, {0.6F, 0.0F, 0.0F}};
}

SE3 drifting(double t) {
  return scene::world_from_camera_at(0.2 * t, 0.0, 0.1 * t, 0.1 * t);
}

/// Runs a film with the boxes of every `every`-th frame, which arrive `late` frames after their own. Boxes
/// still on their way at the end are handed out then.
PersonTracks run(const Film& film, int every, int late, std::uint64_t seed = 0) {
  PersonTracks tracks = new_tracks(seed);
  for (int i = 0; i < film.size(); ++i) {
    film.begin(tracks, i);
    tracks.set_keypoints({});
    const bool last = i + 1 == film.size();
    for (int from = std::max(0, i - late); from <= (last ? i : i - late); ++from) {
      if (from % every == 0) tracks.add_detections(film.detections(from));
    }
    film.end(tracks, i);
  }
  return tracks;
}

TEST(PersonTracks, NobodyAtFirst) {
  const Film film(room().person(walker()), 1);
  PersonTracks tracks = new_tracks();
  film.begin(tracks, 0);
  EXPECT_TRUE(tracks.tracks().empty());
  EXPECT_EQ(cv::countNonZero(tracks.labels()), 0);
  EXPECT_EQ(tracks.labels().size(), tracks.camera().size());
}

TEST(PersonTracks, FollowDetectionsOfEveryFrame) {
  const Film film(room().person(walker()), 45, drifting);
  PersonTracks tracks = new_tracks();
  double sum = 0.0;
  for (int i = 0; i < film.size(); ++i) {
    film.begin(tracks, i);
    tracks.set_keypoints({});
    tracks.add_detections(film.detections(i));
    film.end(tracks, i);
    ASSERT_EQ(tracks.tracks().size(), 1U) << i;
    sum += film.iou(tracks, i);
  }
  EXPECT_GT(sum / film.size(), 0.8);
}

TEST(PersonTracks, ArePredictedBeforeTheFramesBoxesCome) {
  const Film film(room().person(walker()), 45, drifting);
  PersonTracks tracks = new_tracks();
  for (int i = 0; i < film.size(); ++i) {
    film.begin(tracks, i);
    if (i > 0) {
      ASSERT_GT(film.iou(tracks, i), 0.55) << i;
    }
    tracks.add_detections(film.detections(i));
    film.end(tracks, i);
  }
}

TEST(PersonTracks, CarrySomebodyBetweenSeldomDetections) {
  // Three a second.
  const Film film(room().person(walker()), 60, drifting);
  PersonTracks tracks = new_tracks();
  double sum = 0.0;
  for (int i = 0; i < film.size(); ++i) {
    film.begin(tracks, i);
    if (i % 10 == 0) tracks.add_detections(film.detections(i));
    film.end(tracks, i);
    sum += film.iou(tracks, i);
  }
  EXPECT_GT(sum / film.size(), 0.7);
}

TEST(PersonTracks, LateDetectionsGiveWhatDetectionsInTimeDo) {
  const Film film(room().person(walker()), 45, drifting);
  for (const int late : {3, 5, 12}) {
    const PersonTracks in_time = run(film, 5, 0);
    const PersonTracks behind = run(film, 5, late);
    ASSERT_EQ(in_time.tracks().size(), 1U);
    ASSERT_EQ(behind.tracks().size(), 1U);
    const cv::Mat a = in_time.labels() != 0, b = behind.labels() != 0;
    const double same = double(cv::countNonZero(a & b)) / double(cv::countNonZero(a | b));
    EXPECT_GT(same, 0.85) << late;
    EXPECT_EQ(in_time.tracks()[0].confirmations, behind.tracks()[0].confirmations) << late;
    EXPECT_EQ(in_time.tracks()[0].confirmed_s, behind.tracks()[0].confirmed_s) << late;
  }
}

TEST(PersonTracks, ALateDetectionFindsSomebodyWhereHeIsByNow) {
  for (const float speed_m_per_s : {0.0F, 0.6F}) {
    Person person = walker();
    person.velocity_m_per_s.x() = speed_m_per_s;
    const Film film(room().person(person), 16);
    PersonTracks tracks = new_tracks();
    for (int i = 0; i < film.size(); ++i) {
      film.begin(tracks, i);
      tracks.end_frame(SE3(), false);
    }
    EXPECT_TRUE(tracks.tracks().empty());
    tracks.add_detections(film.detections(3));
    ASSERT_EQ(tracks.tracks().size(), 1U) << speed_m_per_s;
    EXPECT_GT(film.iou(tracks, film.size() - 1), 0.5) << speed_m_per_s;
  }
}

TEST(PersonTracks, KeepWhoStandsStillBetweenDetections) {
  Person person = walker();
  person.velocity_m_per_s.setZero();
  const Film film(room().person(person), 60, drifting);
  PersonTracks tracks = new_tracks();
  for (int i = 0; i < film.size(); ++i) {
    film.begin(tracks, i);
    if (i % 20 == 0) tracks.add_detections(film.detections(i));
    film.end(tracks, i);
    ASSERT_GT(film.iou(tracks, i), 0.6) << i;
  }
}

TEST(PersonTracks, FollowWhoWalksInBeforeHeIsDetected) {
  Person person = walker();
  person.feet = {-2.0F, kCameraHeightM, 2.5F};
  person.velocity_m_per_s.x() = 1.0F;
  const Film film(DepthScene().wall(4.5F).floor().person(person), 60);
  PersonTracks tracks = new_tracks();
  for (int i = 0; i < film.size(); ++i) {
    film.begin(tracks, i);
    film.end(tracks, i);
  }
  EXPECT_GT(film.iou(tracks, film.size() - 1), 0.4);
}

TEST(PersonTracks, TakeNoFurnitureForSomebody) {
  const auto path = [](double t) { return scene::world_from_camera_at(0.3 * t, 0.0, 0.2 * t, 0.2 * t); };
  const Film film(room().block({-1.2F, -0.6F, 2.6F}, {-0.6F, 1.2F, 3.0F}), 45, path);
  PersonTracks tracks = new_tracks();
  int cells = 0;
  for (int i = 0; i < film.size(); ++i) {
    film.begin(tracks, i);
    cells += cv::countNonZero(tracks.labels());
    film.end(tracks, i);
  }
  EXPECT_LT(cells / film.size(), tracks.camera().n_cells() / 100);
}

TEST(PersonTracks, ReplayWithTheMotionThatWasFoundInTheEnd) {
  const auto path = [](double t) { return scene::world_from_camera_at(0.0, 0.0, 0.0, 0.9 * t); };
  const Film film(DepthScene().wall(4.5F).person({1, {0.4F, kCameraHeightM, 2.7F}}), 20, path);
  const auto late_iou = [&film](bool expected_wrongly) {
    PersonTracks tracks = new_tracks();
    for (int i = 0; i < film.size(); ++i) {
      const SE3& found = film.moved[std::size_t(i)];
      tracks.begin_frame(std::uint64_t(i), Film::time_s(i), film.views[std::size_t(i)].depth_m,
                         expected_wrongly ? SE3() : found);
      tracks.end_frame(found, true);
    }
    tracks.add_detections(film.detections(2));
    return tracks.tracks().empty() ? 0.0 : film.iou(tracks, film.size() - 1);
  };
  EXPECT_GT(late_iou(false), 0.6);
  EXPECT_GT(late_iou(true), 0.6);
}

TEST(PersonTracks, MissedDetectionsDoNotFreeHim) {
  const Film film(room().person(walker()), 45);
  PersonTracks tracks = new_tracks();
  for (int i = 0; i < film.size(); ++i) {
    film.begin(tracks, i);
    const bool missed = i == 20 || i == 25 || i == 40;
    if (i % 5 == 0)
      tracks.add_detections(missed ? Detections{std::uint64_t(i), Film::time_s(i), {}} : film.detections(i));
    film.end(tracks, i);
    ASSERT_EQ(tracks.tracks().size(), 1U) << i;
    ASSERT_GT(film.iou(tracks, i), 0.5) << i;
  }
}

TEST(PersonTracks, ForgetWhoHasLeft) {
  Person leaves = walker();
  leaves.feet.x() = 0.6F;
  leaves.velocity_m_per_s.x() = 2.0F;
  const Film film(DepthScene().wall(4.5F).floor().person(leaves), 75);
  PersonTracks tracks = run(film, 3, 0);
  EXPECT_TRUE(tracks.tracks().empty());
}

TEST(PersonTracks, ForgetAFalseDetection) {
  const Film film(room(), 45);
  PersonTracks tracks = new_tracks();
  const PersonBox wall{200.0, 50.0, 90.0, 160.0, 0.4};
  for (int i = 0; i < film.size(); ++i) {
    film.begin(tracks, i);
    if (i % 5 == 0)
      tracks.add_detections(
          {std::uint64_t(i), Film::time_s(i), i == 0 ? std::vector{wall} : std::vector<PersonBox>{}});
    film.end(tracks, i);
  }
  EXPECT_TRUE(tracks.tracks().empty());
}

TEST(PersonTracks, KeepTwoApartWhoCross) {
  const Film film(DepthScene()
                      .wall(5.0F)
                      .floor()
                      .person({1, {-0.7F, kCameraHeightM, 2.4F}, {0.8F, 0.0F, 0.0F}})
                      .person({2, {0.9F, kCameraHeightM, 3.5F}, {-0.8F, 0.0F, 0.0F}}),
                  60);
  PersonTracks tracks = new_tracks();
  double sum = 0.0;
  for (int i = 0; i < film.size(); ++i) {
    film.begin(tracks, i);
    if (i % 3 == 0) tracks.add_detections(film.detections(i));
    film.end(tracks, i);
    sum += film.iou(tracks, i);
  }
  EXPECT_GT(sum / film.size(), 0.7);
  const auto detected = std::count_if(tracks.tracks().begin(), tracks.tracks().end(),
                                      [](const PersonTrack& t) { return t.confirmations > 2; });
  EXPECT_EQ(detected, 2);
}

TEST(PersonTracks, IgnoreDetectionsOfFramesTheyDoNotKnow) {
  const Film film(room().person(walker()), 3);
  PersonTracks tracks = new_tracks();
  for (int i = 0; i < 3; ++i) film.begin(tracks, i);
  Detections unknown = film.detections(1);
  unknown.frame = 77;
  tracks.add_detections(unknown);
  EXPECT_TRUE(tracks.tracks().empty());
}

TEST(PersonTracks, IgnoreDetectionsThatComeFarTooLate) {
  const Film film(room().person(walker()), 2);
  PersonTracks tracks = new_tracks();
  film.begin(tracks, 0);
  for (int i = 1; i < 20; ++i)
    tracks.begin_frame(std::uint64_t(i), kBeginS + 0.25 * i, film.views[1].depth_m, SE3());
  tracks.add_detections(film.detections(0));
  EXPECT_TRUE(tracks.tracks().empty());
}

TEST(PersonTracks, IgnoreBoxesThatAreNone) {
  const Film film(room().person(walker()), 2);
  PersonTracks tracks = new_tracks();
  film.begin(tracks, 0);
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  Detections detections = film.detections(0);
  for (const PersonBox& box : {PersonBox{kNaN, 10.0, 50.0, 50.0}, PersonBox{10.0, 10.0, kNaN, 50.0},
                               PersonBox{10.0, 10.0, -50.0, 50.0}, PersonBox{900.0, 10.0, 50.0, 50.0}})
    detections.boxes.insert(detections.boxes.begin(), box);
  tracks.add_detections(detections);
  ASSERT_EQ(tracks.tracks().size(), 1U);
  EXPECT_GT(film.iou(tracks, 0), 0.7);
}

/// Points all over the first frame of a film, and where they are seen later: those on the person move along
/// with him.
class FilmKeypoints {
 public:
  FilmKeypoints(const Film& film, const Person& person) : velocity_(person.velocity_m_per_s.cast<double>()) {
    const GridCamera grid(camera_);
    Random random(3);
    for (const DepthKeypoint& k : scene::keypoints_on(film.views[0], 2)) {
      if (k.depth_m <= 0.0F) continue;
      points_.push_back(camera_.back_project({double(k.x), double(k.y)}, double(k.depth_m)));
      on_person_.push_back(film.views[0].owner(grid.cell_of_pixel(k.x, k.y)) == person.number);
      looks_.push_back(synthetic::random_descriptor(random));
    }
  }
  [[nodiscard]] auto n_on_person() const { return std::count(on_person_.begin(), on_person_.end(), true); }
  /// this_from_first: of the camera.
  [[nodiscard]] FlowKeypoints seen(double time_s, const SE3& this_from_first) const {
    FlowKeypoints keypoints;
    for (std::size_t p = 0; p < points_.size(); ++p) {
      const Eigen::Vector3d step = (on_person_[p] ? time_s : 0.0) * velocity_;
      const Eigen::Vector3d now = this_from_first * (points_[p] + step);
      const Eigen::Vector2d px = camera_.project(now);
      keypoints.keypoints.push_back({float(px.x()), float(px.y()), float(now.z())});
      keypoints.descriptors.push_back(looks_[p]);
    }
    return keypoints;
  }

 private:
  PinholeCamera camera_{scene::camera_settings()};
  Eigen::Vector3d velocity_;
  std::vector<Eigen::Vector3d> points_;
  std::vector<bool> on_person_;
  std::vector<Descriptor> looks_;
};

TEST(PersonTracks, LearnTheVelocityFromKeypoints) {
  const Person person = walker();
  const Film film(room().person(person), 4);
  const FilmKeypoints keypoints(film, person);
  ASSERT_GT(keypoints.n_on_person(), 50);
  PersonTracks tracks = new_tracks();
  for (int i = 0; i < film.size(); ++i) {
    film.begin(tracks, i);
    tracks.set_keypoints(keypoints.seen(i * kStepS, SE3()));
    if (i == 0) tracks.add_detections(film.detections(0));
    film.end(tracks, i);
  }
  ASSERT_EQ(tracks.tracks().size(), 1U);
  EXPECT_TRUE(is_walking(tracks.tracks()[0]));
  EXPECT_NEAR(tracks.tracks()[0].velocity_m_per_s.x(), 0.6F, 0.06F);
}

TEST(PersonTracks, DoNotTakeATurnThatNobodyExpectedForTheirVelocity) {
  Person person = walker();
  person.velocity_m_per_s.setZero();
  const auto turning = [](double t) { return scene::world_from_camera_at(0.0, 0.0, 0.0, 0.5 * t); };
  const Film film(room().person(person), 4, turning);
  const FilmKeypoints keypoints(film, person);
  PersonTracks tracks = new_tracks();
  for (int i = 0; i < film.size(); ++i) {
    tracks.begin_frame(std::uint64_t(i), Film::time_s(i), film.views[std::size_t(i)].depth_m, SE3());
    tracks.set_keypoints(keypoints.seen(i * kStepS, turning(i * kStepS).inverse() * turning(0.0)));
    if (i == 0) tracks.add_detections(film.detections(0));
    // Before tracking has found the motion.
    ASSERT_EQ(tracks.tracks().size(), 1U);
    EXPECT_LT(tracks.tracks()[0].velocity_m_per_s.norm(), 0.2F) << i;
    film.end(tracks, i);
  }
}

TEST(PersonTracks, AreTheSameRunAfterRun) {
  const Film film(room().person(walker()), 30, drifting);
  const PersonTracks a = run(film, 4, 3, 5);
  const PersonTracks b = run(film, 4, 3, 5);
  ASSERT_EQ(a.tracks().size(), b.tracks().size());
  EXPECT_EQ(cv::countNonZero(a.labels() != b.labels()), 0);
  EXPECT_EQ(a.tracks()[0].velocity_m_per_s, b.tracks()[0].velocity_m_per_s);
}

}  // namespace
}  // namespace cpslam
