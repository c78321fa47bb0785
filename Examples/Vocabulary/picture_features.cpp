#include "picture_features.h"

#include <opencv2/imgproc.hpp>

#include "common/left_out.h"
#include "common/picture_source.h"
#include "common/progress_bar.h"
#include "common/stop_signal.h"
#include "cpslam/error.h"
#include "features/orb_extractor.h"
#include "io/image_reader.h"
#include "io/tum_sequence.h"

namespace cpslam::program {
namespace {

std::vector<std::string> select_pictures(const PictureSelection& selection) {
  std::vector<std::string> paths;
  for (const std::string& source : selection.sources) {
    const std::vector<Picture> pictures = find_pictures(source);
    // Only the pictures of sequences have stamps, and only they resemble their neighbours.
    const std::size_t step = pictures.front().time_s ? selection.every : 1;
    for (std::size_t i = 0; i < pictures.size(); i += step) paths.push_back(pictures[i].path);
  }
  return paths;
}

cv::Mat read_grey(const std::string& path) {
  cv::Mat picture = read_colour_image(path);
  if (picture.channels() == 1) return picture;
  cv::Mat grey;
  cv::cvtColor(picture, grey, cv::COLOR_BGR2GRAY);
  return grey;
}

}  // namespace

std::vector<ImageDescriptors> extract_features(const PictureSelection& selection, const OrbSettings& settings,
                                               bool quiet) {
  const std::vector<std::string> paths = select_pictures(selection);
  ProgressBar bar("features", paths.size(), !quiet);
  LeftOut left_out("picture", bar);
  OrbExtractor extractor(settings);
  OrbFeatures features;
  std::vector<ImageDescriptors> images;
  for (std::size_t i = 0; i < paths.size(); ++i) {
    if (stop_requested()) throw RunError("interrupted: nothing was written");
    try {
      extractor.extract(read_grey(paths[i]), features);
      if (features.descriptors.empty()) {
        left_out.add("'" + paths[i] + "'", "no feature was found in it");
      } else {
        images.push_back(features.descriptors);
      }
    } catch (const InputError& error) {
      left_out.add("'" + paths[i] + "'", error.what());
    }
    bar.update(i + 1);
  }
  bar.finish();
  if (images.empty())
    throw InputError("none of the " + std::to_string(paths.size()) + " pictures could be used");
  return images;
}

}  // namespace cpslam::program
