#include "io/text_table.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdio>

#include "cpslam/error.h"
#include "io/input_file.h"

namespace cpslam {

std::optional<double> parse_number(std::string_view text) {
  // from_chars knows no plus sign.
  if (text.size() > 1 && text[0] == '+' && text[1] != '-') text.remove_prefix(1);
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value)) return std::nullopt;
  return value;
}

std::string stamp_text(double time_s) {
  std::array<char, 400> text{};
  std::snprintf(text.data(), text.size(), "%.6f", time_s);
  return text.data();
}

std::string printable(std::string_view text) {
  constexpr std::size_t kLongest = 60;
  std::string result(text.substr(0, kLongest));
  for (char& c : result) {
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7F) c = '?';
  }
  if (text.size() > kLongest) result += "...";
  return result;
}

TextTable::TextTable(const std::string& path) : path_(path), content_(read_input_file(path)) {
  constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
  if (content_.starts_with(kByteOrderMark)) position_ = kByteOrderMark.size();
}

bool TextTable::next_row() {
  while (position_ < content_.size()) {
    const std::size_t end = std::min(content_.find('\n', position_), content_.size());
    ++line_;
    split(std::string_view(content_).substr(position_, end - position_));
    position_ = end + 1;
    if (!fields_.empty()) return true;
  }
  return false;
}

void TextTable::split(std::string_view line) {
  constexpr std::string_view kSeparators = " \t\r,";
  fields_.clear();
  std::size_t begin = line.find_first_not_of(kSeparators);
  while (begin < line.size() && line[begin] != '#') {
    const std::size_t end = std::min(line.find_first_of(kSeparators, begin), line.size());
    fields_.push_back(line.substr(begin, end - begin));
    begin = line.find_first_not_of(kSeparators, end);
  }
}

void TextTable::expect_fields(std::size_t count, std::string_view form) const {
  if (fields_.size() == count) return;
  fail("expected '" + std::string(form) + "', found " + std::to_string(fields_.size()) +
       (fields_.size() == 1 ? " field" : " fields"));
}

double TextTable::number(std::size_t field) const {
  const std::optional<double> value = parse_number(fields_[field]);
  if (!value) fail("'" + printable(fields_[field]) + "' is not a finite number");
  return *value;
}

void TextTable::fail(const std::string& what) const {
  throw InputError(path_ + ":" + std::to_string(line_) + ": " + what);
}

void TextTable::fail_file(const std::string& what) const {
  throw InputError("'" + path_ + "' " + what);
}

}  // namespace cpslam
