#include "detect/darknet_transcript.h"

#include <algorithm>
#include <array>

#include "io/settings_keys.h"

namespace cpslam {
namespace {

constexpr auto kActivations =
    std::to_array<std::string_view>({"linear", "leaky", "relu", "swish", "mish", "logistic"});

struct UnsupportedKey {
  std::string_view key;
  std::string_view harmless;  // the value that changes nothing
};
constexpr auto kUnsupported = std::to_array<UnsupportedKey>({
    {"antialiasing", "0"},
    {"binary", "0"},
    {"deform", "0"},
    {"dilation", "1"},
    {"flipped", "0"},
    {"maxpool_depth", "0"},
    {"reverse", "0"},
    {"scale", "1"},
    {"share_index", ""},
    {"stride_x", ""},
    {"stride_y", ""},
    {"weights_type", "none"},
    {"xnor", "0"},
});

template <typename Number>
std::string joined(const std::vector<Number>& numbers) {
  std::string text;
  for (const Number number : numbers) {
    if (!text.empty()) text += ',';
    text += number_text(number);
  }
  return text;
}

}  // namespace

DarknetTranscript::DarknetTranscript(const DarknetSection& section)
    : section_(&section), text_(std::string("[") + section.kind() + "]\n") {
  for (const UnsupportedKey& entry : kUnsupported) {
    if (section.optional_text(entry.key, entry.harmless) == entry.harmless) continue;
    section.fail(std::string(entry.key) + "= is not supported", entry.key);
  }
}

void DarknetTranscript::write(std::string_view key, std::string_view value) {
  text_ += std::string(key) + "=" + std::string(value) + "\n";
}

int DarknetTranscript::required(std::string_view key, int lowest, int highest) {
  const int value = section_->required_int(key, lowest, highest);
  write(key, std::to_string(value));
  return value;
}

int DarknetTranscript::optional(std::string_view key, int fallback, int lowest, int highest) {
  const int value = section_->optional_int(key, fallback, lowest, highest);
  write(key, std::to_string(value));
  return value;
}

double DarknetTranscript::optional_number(std::string_view key, double fallback, double lowest,
                                          double highest) {
  const double value = section_->optional_number(key, fallback, lowest, highest);
  write(key, number_text(value));
  return value;
}

std::vector<int> DarknetTranscript::required_ints(std::string_view key, int lowest, int highest) {
  std::vector<int> values = section_->required_ints(key, lowest, highest);
  write(key, joined(values));
  return values;
}

std::vector<double> DarknetTranscript::required_numbers(std::string_view key, double lowest, double highest) {
  std::vector<double> values = section_->required_numbers(key, lowest, highest);
  write(key, joined(values));
  return values;
}

void DarknetTranscript::activation(std::string_view fallback) {
  const std::string_view name = fallback.empty() ? section_->required_text("activation")
                                                 : section_->optional_text("activation", fallback);
  if (std::find(kActivations.begin(), kActivations.end(), name) == kActivations.end()) {
    section_->fail("activation must be linear, leaky, relu, swish (for silu), mish or logistic",
                   "activation");
  }
  write("activation", name);
}

}  // namespace cpslam
