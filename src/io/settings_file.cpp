#include <cmath>
#include <cstddef>
#include <map>
#include <optional>
#include <string_view>

#include "cpslam/error.h"
#include "io/input_file.h"
#include "io/settings_keys.h"
#include "io/text_table.h"

// The files are the flat subset of YAML that ORB-SLAM2 uses: a %YAML line, then "key: value". Reading them
// ourselves instead of through cv::FileStorage gives errors with line numbers, finds repeated keys and does
// not wrap large integers round.

namespace cpslam {
namespace {

constexpr std::string_view kBlanks = " \t\r";

std::string_view trim(std::string_view text) {
  const std::size_t begin = text.find_first_not_of(kBlanks);
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(kBlanks) - begin + 1);
}

/// Without the comment: a '#' at the beginning or after a blank.
std::string_view without_comment(std::string_view line) {
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (line[i] == '#' && (i == 0 || kBlanks.find(line[i - 1]) != std::string_view::npos))
      return line.substr(0, i);
  }
  return line;
}

class SettingsReader {
 public:
  explicit SettingsReader(const std::string& path) : path_(path) {}

  Settings read() {
    const std::string content = read_input_file(path_);
    std::string_view rest = content;
    while (!rest.empty()) {
      const std::size_t end = std::min(rest.find('\n'), rest.size());
      ++line_;
      read_line(rest.substr(0, end));
      rest.remove_prefix(std::min(end + 1, rest.size()));
    }
    check_required();
    // ORB-SLAM2's convention: a factor of 0 means that depth comes in metres.
    double& factor = settings_.camera.depth_map_factor;
    if (std::abs(factor) < 1e-5) factor = 1.0;
    return settings_;
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    throw InputError(path_ + ":" + std::to_string(line_) + ": " + what);
  }

  void read_line(std::string_view raw) {
    if (line_ == 1) {
      if (raw.starts_with("\xEF\xBB\xBF")) raw.remove_prefix(3);
      if (!raw.starts_with("%YAML")) fail("a settings file begins with the line %YAML:1.0");
      return;
    }
    const std::string_view line = without_comment(raw);
    const std::string_view text = trim(line);
    if (text.empty() || text == "---" || text == "...") return;
    if (kBlanks.find(line[0]) != std::string_view::npos) {
      // More of the value above, as the matrices of stereo files have.
      if (!in_ignored_value_) fail("'" + printable(text) + "' must not be indented");
      return;
    }
    const std::size_t colon = text.find(':');
    if (colon == std::string_view::npos) fail("'" + printable(text) + "' is not of the form 'key: value'");
    read_key(trim(text.substr(0, colon)), trim(text.substr(colon + 1)));
  }

  void read_key(std::string_view name, std::string_view value) {
    const auto [earlier, is_new] = lines_.emplace(name, line_);
    if (!is_new) {
      fail("key " + printable(name) + " was given before, in line " + std::to_string(earlier->second));
    }
    in_ignored_value_ = is_ignored_settings_key(name);
    if (in_ignored_value_) return;
    const SettingsKey* key = find_settings_key(name);
    if (key == nullptr) fail_unknown(name);
    assign(*key, value);
  }

  [[noreturn]] void fail_unknown(std::string_view name) const {
    const std::string nearest = nearest_settings_key(name);
    fail("unknown key '" + printable(name) + "'" +
         (nearest.empty() ? "" : "; did you mean " + nearest + "?"));
  }

  void assign(const SettingsKey& key, std::string_view text) {
    const std::string name(key.name);
    const std::optional<double> value = parse_number(text);
    if (!value) fail(name + ": '" + printable(text) + "' is not a number");
    const bool depth_in_metres = key.name == "DepthMapFactor" && std::abs(*value) < 1e-5;
    if (const std::string error = range_error(key, *value); !error.empty() && !depth_in_metres) fail(error);
    const SettingsMember member = key.member(settings_);
    if (double* const* real = std::get_if<double*>(&member)) {
      **real = *value;
      return;
    }
    if (*value != std::floor(*value)) fail(name + ": " + printable(text) + " is not a whole number");
    *std::get<int*>(member) = static_cast<int>(*value);
  }

  void check_required() const {
    for (const SettingsKey& key : settings_keys()) {
      if (!key.required || lines_.contains(key.name)) continue;
      throw InputError("'" + path_ + "' lacks the key " + std::string(key.name));
    }
  }

  std::string path_;
  std::size_t line_ = 0;
  std::map<std::string, std::size_t, std::less<>> lines_;  // where each key stands
  bool in_ignored_value_ = false;
  Settings settings_;
};

std::string member_text(const SettingsMember& member) {
  if (double* const* real = std::get_if<double*>(&member)) {
    const std::string text = number_text(**real);
    return text.find_first_of(".e") == std::string::npos ? text + ".0" : text;
  }
  return std::to_string(*std::get<int*>(member));
}

double as_number(const SettingsMember& member) {
  return std::visit([](const auto* value) { return static_cast<double>(*value); }, member);
}

}  // namespace

void Settings::check() const {
  Settings copy = *this;  // the key table hands out pointers to change
  for (const SettingsKey& key : settings_keys()) {
    if (const std::string error = range_error(key, as_number(key.member(copy))); !error.empty()) {
      throw InputError(error);
    }
  }
  if (dense.memory_mb < 1)
    throw InputError("dense.memory_mb: must be at least 1, not " + std::to_string(dense.memory_mb));
  if (orb.min_th_fast > orb.ini_th_fast) {
    throw InputError("ORBextractor.minThFAST: " + std::to_string(orb.min_th_fast) +
                     " is above ORBextractor.iniThFAST, " + std::to_string(orb.ini_th_fast));
  }
  if (localization && load_map.empty()) throw InputError("localization needs a map to localise in: load_map");
  if (!load_map.empty() && vocabulary.empty())
    throw InputError("load_map needs a vocabulary to find the camera with");
}

Settings load_settings(const std::string& path) {
  const Settings settings = SettingsReader(path).read();
  try {
    settings.check();
  } catch (const InputError& error) {
    throw InputError("'" + path + "': " + error.what());
  }
  return settings;
}

std::string to_yaml(const Settings& settings) {
  Settings copy = settings;
  std::string text = "%YAML:1.0\n---\n";
  for (const SettingsKey& key : settings_keys()) {
    text += std::string(key.name) + ": " + member_text(key.member(copy)) + "\n";
  }
  return text;
}

}  // namespace cpslam
