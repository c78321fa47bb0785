#include "detect/darknet_network.h"

#include <algorithm>
#include <string>
#include <string_view>

#include "detect/darknet_transcript.h"

namespace cpslam {
namespace {

constexpr int kMaxInput = 4096;
constexpr int kMaxFilters = 1 << 16;
constexpr int kMaxWindow = 64;  // size, stride, padding of a convolution or a pooling
constexpr int kMaxLayers = 100000;
constexpr int kMaxClasses = 80;
constexpr std::size_t kMaxHeads = 3;
/// Of all layers together: 2 GB of floats. YOLOv3 at 1024 x 1024 has 0.3e9.
constexpr double kMaxActivations = 512e6;

class NetworkReader {
 public:
  NetworkReader(const std::vector<DarknetSection>& sections, cv::Size input_px) : sections_(sections) {
    const DarknetSection& net = sections.front();
    network_.input.width = input_px.width > 0 ? input_px.width : net.required_int("width", 1, kMaxInput);
    network_.input.height = input_px.height > 0 ? input_px.height : net.required_int("height", 1, kMaxInput);
    if (std::max(network_.input.width, network_.input.height) > kMaxInput) {
      net.fail("the input may have at most " + std::to_string(kMaxInput) + " px a side");
    }
    if (net.required_int("channels", 1, kMaxFilters) != 3)
      net.fail("channels must be 3 (colour)", "channels");
    network_.config = "[net]\nwidth=" + std::to_string(network_.input.width) +
                      "\nheight=" + std::to_string(network_.input.height) + "\nchannels=3\n";
  }

  DarknetNetwork read() {
    previous_ = {"net", {network_.input.width, network_.input.height, 3}, 1, 0};
    for (std::size_t i = 1; i < sections_.size(); ++i) {
      section_ = &sections_[i];
      DarknetTranscript transcript(*section_);
      add(read_layer(transcript));
      network_.config += transcript.text();
    }
    check_whole();
    return std::move(network_);
  }

 private:
  DarknetLayer read_layer(DarknetTranscript& values) {
    const std::string& kind = section_->kind();
    if (kind == "convolutional") return convolutional(values);
    if (kind == "maxpool") return maxpool(values);
    if (kind == "upsample") return upsample(values);
    if (kind == "route") return route(values);
    if (kind == "shortcut") return shortcut(values);
    if (kind == "dropout") return previous_;
    if (kind == "yolo") return yolo(values);
    section_->fail("is a kind of layer that is not supported");
  }

  /// Sides after a window of `size` moves over the image by `stride`, `padding` cells more on both sides
  /// together.
  void slide_window(DarknetLayer& layer, int size, int stride, int padding) const {
    const int width = previous_.output.width + padding - size;
    const int height = previous_.output.height + padding - size;
    if (width < 0 || height < 0) section_->fail("the window is larger than its input");
    layer.output.width = width / stride + 1;
    layer.output.height = height / stride + 1;
    layer.stride = previous_.stride * stride;
    if (layer.stride > kMaxInput) section_->fail("nothing is left of the input after so many strides");
  }

  DarknetLayer convolutional(DarknetTranscript& values) {
    const int filters = values.required("filters", 1, kMaxFilters);
    const int size = values.required("size", 1, kMaxWindow);
    const int stride = values.optional("stride", 1, 1, kMaxWindow);
    const int groups = values.optional("groups", 1, 1, kMaxFilters);
    const bool normalise = values.optional("batch_normalize", 0, 0, 1) == 1;
    const bool pad = section_->optional_int("pad", 0, 0, 1) == 1;
    const int padding = pad ? size / 2 : section_->optional_int("padding", 0, 0, kMaxWindow);
    values.write("padding", std::to_string(padding));
    values.activation();
    const int channels = previous_.output.channels;
    if (channels % groups != 0 || filters % groups != 0) {
      section_->fail("groups must divide the " + std::to_string(channels) +
                         " channels that come in and the " + std::to_string(filters) + " filters",
                     "groups");
    }
    DarknetLayer layer;
    layer.output.channels = filters;
    slide_window(layer, size, stride, 2 * padding);
    const auto n = [](int value) { return static_cast<std::size_t>(value); };
    // Filter taps and bias; with batch normalisation also scale, mean and variance.
    layer.n_weights = n(filters) * n(channels / groups) * n(size * size) + n(filters) * (normalise ? 4U : 1U);
    return layer;
  }

  DarknetLayer maxpool(DarknetTranscript& values) {
    const int size = values.required("size", 1, kMaxWindow);
    const int stride = values.required("stride", 1, kMaxWindow);
    const int padding = values.optional("padding", size - 1, 0, size - 1);
    DarknetLayer layer;
    layer.output.channels = previous_.output.channels;
    slide_window(layer, size, stride, padding);
    return layer;
  }

  DarknetLayer upsample(DarknetTranscript& values) {
    const int factor = values.optional("stride", 2, 1, kMaxWindow);
    if (previous_.stride % factor != 0) section_->fail("makes more of the input than it had", "stride");
    DarknetLayer layer = previous_;
    layer.stride /= factor;
    layer.output.width *= factor;
    layer.output.height *= factor;
    return layer;
  }

  /// index: from the first layer, or negative from this one.
  const DarknetLayer& layer_at(int index, std::string_view key) const {
    const auto here = static_cast<int>(network_.layers.size());
    const int absolute = index < 0 ? here + index : index;
    if (absolute < 0 || absolute >= here) {
      section_->fail(std::string(key) + ": there is no layer " + std::to_string(index) + " before this one",
                     key);
    }
    return network_.layers[static_cast<std::size_t>(absolute)];
  }

  DarknetLayer route(DarknetTranscript& values) {
    const std::vector<int> indices = values.required_ints("layers", -kMaxLayers, kMaxLayers);
    const int groups = values.optional("groups", 1, 1, kMaxFilters);
    values.optional("group_id", 0, 0, groups - 1);
    DarknetLayer layer = layer_at(indices.front(), "layers");
    for (std::size_t i = 1; i < indices.size(); ++i) {
      const DarknetLayer& other = layer_at(indices[i], "layers");
      if (other.output.width != layer.output.width || other.output.height != layer.output.height ||
          other.stride != layer.stride) {
        // The halves of an odd size, doubled again, are another size.
        if (other.stride == layer.stride) check_input_size();
        section_->fail("joins layers of different sizes", "layers");
      }
      layer.output.channels += other.output.channels;
      if (layer.output.channels > kMaxFilters) section_->fail("joins too many channels", "layers");
    }
    if (groups > 1 && indices.size() > 1) section_->fail("groups= goes with a single layer only", "groups");
    if (layer.output.channels % groups != 0) section_->fail("groups must divide the channels", "groups");
    layer.output.channels /= groups;
    return layer;
  }

  DarknetLayer shortcut(DarknetTranscript& values) {
    const std::vector<int> from = values.required_ints("from", -kMaxLayers, kMaxLayers);
    if (from.size() != 1) section_->fail("takes one layer", "from");
    values.activation("linear");
    if (layer_at(from.front(), "from").output != previous_.output) {
      section_->fail("adds layers of different shapes", "from");
    }
    return previous_;
  }

  DarknetLayer yolo(DarknetTranscript& values) {
    YoloHead head;
    head.grid_width = previous_.output.width;
    head.grid_height = previous_.output.height;
    head.stride = previous_.stride;
    head.n_classes = values.required("classes", 1, kMaxClasses);
    head.scale_x_y = values.optional_number("scale_x_y", 1.0, 0.5, 4.0);
    values.optional("new_coords", 0, 0, 1);
    const std::vector<double> sides = values.required_numbers("anchors", 1e-3, 1e5);
    const int n_anchors = values.required("num", 1, 100);
    if (sides.size() != 2 * static_cast<std::size_t>(n_anchors)) {
      section_->fail("num=" + std::to_string(n_anchors) + ", but there are " + std::to_string(sides.size()) +
                         " anchor sides",
                     "anchors");
    }
    // OpenCV sets scores up to `thresh` to zero, 0.2 if nobody says otherwise, and drops boxes that overlap:
    // both are the decoder's business.
    values.write("thresh", "0");
    values.write("nms_threshold", "0");
    for (const int index : values.required_ints("mask", 0, n_anchors - 1)) {
      const auto at = 2 * static_cast<std::size_t>(index);
      head.anchors_px.emplace_back(sides[at], sides[at + 1]);
    }
    const int expected = static_cast<int>(head.anchors_px.size()) * (5 + head.n_classes);
    if (expected != previous_.output.channels) {
      section_->fail("takes " + std::to_string(expected) + " channels, anchors x (5 + classes), but gets " +
                     std::to_string(previous_.output.channels));
    }
    if (!network_.heads.empty() && network_.heads.front().n_classes != head.n_classes) {
      section_->fail("must have as many classes as the first [yolo]", "classes");
    }
    network_.heads.push_back(head);
    if (network_.heads.size() > kMaxHeads) section_->fail("is one head too many: at most 3 are supported");
    return previous_;
  }

  void add(DarknetLayer layer) {
    layer.kind = section_->kind();
    if (layer.kind != "convolutional") layer.n_weights = 0;
    activations_ += 1.0 * layer.output.width * layer.output.height * layer.output.channels;
    if (activations_ > kMaxActivations) section_->fail("the network is too large for this input size");
    network_.n_weights += layer.n_weights;
    network_.layers.push_back(layer);
    previous_ = layer;
  }

  void check_whole() {
    if (network_.heads.empty()) sections_.back().fail("is the last section, but there was no [yolo]");
    network_.n_classes = network_.heads.front().n_classes;
    check_input_size();
  }

  void check_input_size() const {
    int stride = 1;
    for (const DarknetLayer& layer : network_.layers) stride = std::max(stride, layer.stride);
    const int width = network_.input.width;
    const int height = network_.input.height;
    if (width % stride == 0 && height % stride == 0) return;
    sections_.front().fail("the input size " + std::to_string(width) + " x " + std::to_string(height) +
                           " must be a multiple of " + std::to_string(stride) +
                           " px, the network's largest stride");
  }

  const std::vector<DarknetSection>& sections_;
  const DarknetSection* section_ = nullptr;
  DarknetNetwork network_;
  DarknetLayer previous_;
  double activations_ = 0.0;
};

}  // namespace

DarknetNetwork read_darknet_network(const std::string& config_text, const std::string& path,
                                    cv::Size input_px) {
  const std::vector<DarknetSection> sections = parse_darknet_config(config_text, path);
  return NetworkReader(sections, input_px).read();
}

}  // namespace cpslam
