#include "detect/darknet_config.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "cpslam/error.h"
#include "io/settings_keys.h"
#include "io/text_table.h"

namespace cpslam {
namespace {

std::string at_line(const std::string& path, std::size_t line) {
  return path + ":" + std::to_string(line) + ": ";
}

std::string without_blanks(std::string_view line) {
  std::string text;
  for (const char c : line) {
    if (c != ' ' && c != '\t' && c != '\r') text += c;
  }
  return text;
}

std::vector<std::string_view> split_at_commas(std::string_view text) {
  std::vector<std::string_view> pieces;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find(','), text.size());
    pieces.push_back(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return pieces;
}

}  // namespace

DarknetSection::DarknetSection(std::string path, std::size_t line, std::string kind)
    : path_(std::move(path)), line_(line), kind_(std::move(kind)) {}

void DarknetSection::fail(const std::string& what, std::string_view key) const {
  const auto found = values_.find(key);
  const std::size_t line = found == values_.end() ? line_ : found->second.line;
  throw InputError(at_line(path_, line) + "[" + printable(kind_) + "] " + what);
}

int DarknetSection::to_int(std::string_view text, std::string_view key, int lowest, int highest) const {
  const double value = to_number(text, key, lowest, highest);
  if (value != std::floor(value)) {
    fail(std::string(key) + ": '" + printable(text) + "' is not a whole number", key);
  }
  return static_cast<int>(value);
}

double DarknetSection::to_number(std::string_view text, std::string_view key, double lowest,
                                 double highest) const {
  const std::optional<double> value = parse_number(text);
  if (!value) fail(std::string(key) + ": '" + printable(text) + "' is not a number", key);
  if (*value < lowest || *value > highest) {
    fail(std::string(key) + ": " + printable(text) + " is outside " + number_text(lowest) + " to " +
             number_text(highest),
         key);
  }
  return *value;
}

std::string_view DarknetSection::required_text(std::string_view key) const {
  const auto found = values_.find(key);
  if (found == values_.end()) fail("lacks '" + std::string(key) + "='");
  return found->second.text;
}

std::string_view DarknetSection::optional_text(std::string_view key, std::string_view fallback) const {
  return has(key) ? required_text(key) : fallback;
}

int DarknetSection::required_int(std::string_view key, int lowest, int highest) const {
  return to_int(required_text(key), key, lowest, highest);
}

int DarknetSection::optional_int(std::string_view key, int fallback, int lowest, int highest) const {
  return has(key) ? required_int(key, lowest, highest) : fallback;
}

double DarknetSection::optional_number(std::string_view key, double fallback, double lowest,
                                       double highest) const {
  return has(key) ? to_number(required_text(key), key, lowest, highest) : fallback;
}

std::vector<double> DarknetSection::required_numbers(std::string_view key, double lowest,
                                                     double highest) const {
  std::vector<double> numbers;
  for (const std::string_view piece : split_at_commas(required_text(key))) {
    numbers.push_back(to_number(piece, key, lowest, highest));
  }
  if (numbers.empty()) fail(std::string(key) + " is empty", key);
  return numbers;
}

std::vector<int> DarknetSection::required_ints(std::string_view key, int lowest, int highest) const {
  std::vector<int> numbers;
  for (const std::string_view piece : split_at_commas(required_text(key))) {
    numbers.push_back(to_int(piece, key, lowest, highest));
  }
  if (numbers.empty()) fail(std::string(key) + " is empty", key);
  return numbers;
}

void DarknetSection::add(std::string_view key, std::string_view value, std::size_t line) {
  const auto [found, is_new] = values_.emplace(key, Value{std::string(value), line});
  // Darknet takes the first of two, OpenCV the last.
  if (!is_new && found->second.text != value) {
    throw InputError(at_line(path_, line) + "[" + printable(kind_) + "] '" + printable(key) +
                     "' has another value in line " + std::to_string(found->second.line));
  }
}

std::vector<DarknetSection> parse_darknet_config(const std::string& text, const std::string& path) {
  std::vector<DarknetSection> sections;
  std::string_view rest = text;
  for (std::size_t number = 1; !rest.empty(); ++number) {
    const std::size_t end = std::min(rest.find('\n'), rest.size());
    const std::string line = without_blanks(rest.substr(0, end));
    rest.remove_prefix(std::min(end + 1, rest.size()));
    if (line.empty() || line[0] == '#' || line[0] == ';') continue;
    const std::size_t equals = line.find('=');
    const bool is_section = line[0] == '[' && line.size() > 2 && line.back() == ']';
    if (is_section) {
      sections.emplace_back(path, number, line.substr(1, line.size() - 2));
    } else if (equals == std::string::npos || equals == 0 || line[0] == '[') {
      throw InputError(at_line(path, number) + "'" + printable(line) + "' is not of the form 'key=value'");
    } else if (!sections.empty()) {
      sections.back().add(line.substr(0, equals), line.substr(equals + 1), number);
    }
    if (sections.empty() || sections.front().kind() != "net") {
      throw InputError(at_line(path, number) + "a Darknet .cfg begins with the section [net]");
    }
  }
  if (sections.size() < 2) throw InputError("'" + path + "' describes no network");
  return sections;
}

}  // namespace cpslam
