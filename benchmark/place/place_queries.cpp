#include "place_queries.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <opencv2/imgproc.hpp>
#include <utility>

#include "common/picture_source.h"
#include "features/orb_extractor.h"
#include "io/association.h"
#include "io/image_reader.h"
#include "io/trajectory_io.h"

namespace cpslam::bench {
namespace {

constexpr double kMaxStampDifferenceS = 0.02;

Relation relate(const PlacedImage& a, const PlacedImage& b, const QueryOptions& options) {
  if (a.sequence != b.sequence) return Relation::kOther;
  const double distance_m = (a.world_from_camera.translation - b.world_from_camera.translation).norm();
  const double angle_deg =
      rotation_angle(a.world_from_camera.rotation.transpose() * b.world_from_camera.rotation) * 180.0 /
      std::numbers::pi;
  if (distance_m <= options.near_m && angle_deg <= options.near_deg) return Relation::kSame;
  const bool far = distance_m > options.far_m || angle_deg > options.far_deg;
  return far ? Relation::kOther : Relation::kUnclear;
}

/// Right answers above the lowest threshold that keeps the share of wrong ones within max_wrong_share, of
/// answers by descending score.
std::size_t right_within(std::span<const Answer> answers, double max_wrong_share) {
  std::size_t right = 0;
  std::size_t wrong = 0;
  std::size_t best = 0;
  for (const Answer& answer : answers) {
    right += answer.relation == Relation::kSame ? 1U : 0U;
    wrong += answer.relation == Relation::kOther ? 1U : 0U;
    if (static_cast<double>(wrong) <= max_wrong_share * static_cast<double>(right + wrong)) best = right;
  }
  return best;
}

std::vector<Descriptor> extract(OrbExtractor& extractor, const std::string& path) {
  cv::Mat image = read_colour_image(path);
  cv::Mat grey = image;
  if (image.channels() == 3) cv::cvtColor(image, grey, cv::COLOR_BGR2GRAY);
  OrbFeatures features;
  extractor.extract(grey, features);
  return std::move(features.descriptors);
}

}  // namespace

std::vector<PlacedImage> load_places(const std::string& source, std::size_t step,
                                     std::size_t& next_sequence) {
  const std::vector<program::Picture> pictures = program::find_pictures(source);
  const std::filesystem::path truth_path = std::filesystem::path(source) / "groundtruth.txt";
  const bool has_truth = std::filesystem::exists(truth_path);
  Trajectory truth;
  if (has_truth) truth = read_trajectory(truth_path.string());
  std::vector<double> picture_times;
  std::vector<double> truth_times;
  for (const program::Picture& picture : pictures) picture_times.push_back(picture.time_s.value_or(0.0));
  for (const StampedPose& pose : truth) truth_times.push_back(pose.time_s);
  std::vector<const StampedPose*> pose_of(pictures.size(), nullptr);
  for (const auto& [picture, pose] : associate_stamps(picture_times, truth_times, kMaxStampDifferenceS))
    pose_of[picture] = &truth[pose];

  OrbExtractor extractor{OrbSettings{}};
  std::vector<PlacedImage> images;
  for (std::size_t i = 0; i < pictures.size(); i += step) {
    if (has_truth && pose_of[i] == nullptr) continue;
    PlacedImage image;
    image.path = pictures[i].path;
    image.sequence = has_truth ? next_sequence : next_sequence++;
    image.time_s = pictures[i].time_s.value_or(0.0);
    if (has_truth) image.world_from_camera = from_pose(pose_of[i]->world_from_camera);
    image.descriptors = extract(extractor, pictures[i].path);
    images.push_back(std::move(image));
  }
  if (has_truth) ++next_sequence;
  return images;
}

std::vector<Answer> ask(const Vocabulary& vocabulary, std::span<const PlacedImage> images,
                        const QueryOptions& options) {
  std::vector<BowVector> bows;
  for (const PlacedImage& image : images) bows.push_back(vocabulary.transform(image.descriptors).bow);
  std::vector<Answer> answers;
  for (std::size_t q = 0; q < images.size(); ++q) {
    Answer answer;
    answer.query = q;
    for (std::size_t i = 0; i < images.size(); ++i) {
      const bool close_in_time = images[i].sequence == images[q].sequence &&
                                 std::abs(images[i].time_s - images[q].time_s) <= options.exclude_s;
      if (close_in_time) continue;
      const Relation relation = relate(images[q], images[i], options);
      answer.answerable = answer.answerable || relation == Relation::kSame;
      const double alike = score(bows[q], bows[i]);
      if (alike <= answer.score) continue;
      answer.first = i;
      answer.score = alike;
      answer.relation = relation;
    }
    answers.push_back(answer);
  }
  return answers;
}

PlaceQuality judge(std::vector<Answer> answers) {
  std::sort(answers.begin(), answers.end(),
            [](const Answer& a, const Answer& b) { return a.score > b.score; });
  PlaceQuality quality;
  for (const Answer& answer : answers) {
    quality.answerable += answer.answerable ? 1U : 0U;
    quality.right += answer.relation == Relation::kSame ? 1U : 0U;
    quality.wrong += answer.relation == Relation::kOther ? 1U : 0U;
  }
  if (quality.answerable == 0) return quality;
  const auto all = static_cast<double>(quality.answerable);
  quality.recall_without_false = static_cast<double>(right_within(answers, 0.0)) / all;
  quality.recall_with_1_percent_false = static_cast<double>(right_within(answers, 0.01)) / all;
  return quality;
}

}  // namespace cpslam::bench
