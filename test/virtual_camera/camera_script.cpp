#include "virtual_camera/camera_script.h"

#include <functional>
#include <map>
#include <sstream>

#include "cpslam/error.h"
#include "io/text_table.h"

namespace cpslam::virtual_camera {
namespace {

double to_number(const std::string& key, const std::string& value) {
  const std::optional<double> number = parse_number(value);
  if (!number) throw InputError("" + key + "='" + value + "' is no number");
  return *number;
}

}  // namespace

CameraScript parse_script(const std::string& text) {
  CameraScript script;
  const std::map<std::string, std::function<void(const std::string&, const std::string&)>> keys{
      {"sequence", [&](const auto&, const auto& value) { script.sequence = value; }},
      {"settings", [&](const auto&, const auto& value) { script.settings = value; }},
      {"fps", [&](const auto& key, const auto& value) { script.fps = to_number(key, value); }},
      {"registration", [&](const auto&, const auto& value) { script.registration = value == "yes"; }},
      {"start-us",
       [&](const auto& key, const auto& value) {
         script.start_us = static_cast<std::uint64_t>(to_number(key, value));
       }},
      {"unplug-after",
       [&](const auto& key, const auto& value) {
         script.unplug_after = static_cast<int>(to_number(key, value));
       }},
      {"return-after",
       [&](const auto& key, const auto& value) { script.return_after = to_number(key, value); }},
      {"stall-after",
       [&](const auto& key, const auto& value) {
         script.stall_after = static_cast<int>(to_number(key, value));
       }},
      {"die-after", [&](const auto& key,
                        const auto& value) { script.die_after = static_cast<int>(to_number(key, value)); }},
      {"jump-after", [&](const auto& key,
                         const auto& value) { script.jump_after = static_cast<int>(to_number(key, value)); }},
      {"jump-us", [&](const auto& key, const auto& value) {
         script.jump_us = static_cast<std::int64_t>(to_number(key, value));
       }}};
  std::istringstream stream(text);
  for (std::string item; std::getline(stream, item, ';');) {
    const std::size_t equals = item.find('=');
    const std::string key = item.substr(0, equals);
    const auto found = keys.find(key);
    if (equals == std::string::npos || found == keys.end())
      throw InputError("'" + item + "' is no key=value of its script");
    found->second(key, item.substr(equals + 1));
  }
  if (script.sequence.empty()) throw InputError("its script names no sequence");
  if (script.settings.empty()) script.settings = script.sequence + "/settings.yaml";
  return script;
}

}  // namespace cpslam::virtual_camera
