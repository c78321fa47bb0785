#pragma once

#include <span>
#include <string>
#include <string_view>
#include <variant>

#include "cpslam/settings.h"

namespace cpslam {

using SettingsMember = std::variant<double*, int*>;

/// One key of a settings file.
struct SettingsKey {
  std::string_view name;
  SettingsMember (*member)(Settings&);
  double lowest;
  double highest;
  bool required = false;
};

/// All keys that mean something to us, in the order in which to_yaml writes them.
[[nodiscard]] std::span<const SettingsKey> settings_keys();

/// Null when there is no such key.
[[nodiscard]] const SettingsKey* find_settings_key(std::string_view name);

/// Keys of ORB-SLAM2 files that mean nothing here (its viewer, its stereo rectification).
[[nodiscard]] bool is_ignored_settings_key(std::string_view name);

/// The known key that is spelled most like `name`; empty when none is near.
[[nodiscard]] std::string nearest_settings_key(std::string_view name);

/// "key: value is outside its range ...", empty when the value (as a number) is within.
[[nodiscard]] std::string range_error(const SettingsKey& key, double value);

/// Shortest text that parses back to the same value, for messages and files.
[[nodiscard]] std::string number_text(double value);

}  // namespace cpslam
