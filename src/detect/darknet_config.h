#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace cpslam {

/// One "[kind]" of a Darknet .cfg with its "key=value" lines. The getters throw InputError of the form
/// "file:line: what" when a value does not parse or lies outside [lowest, highest].
class DarknetSection {
 public:
  DarknetSection(std::string path, std::size_t line, std::string kind);

  [[nodiscard]] const std::string& kind() const { return kind_; }
  [[nodiscard]] bool has(std::string_view key) const { return values_.find(key) != values_.end(); }

  /// Throws InputError when the key is missing.
  [[nodiscard]] int required_int(std::string_view key, int lowest, int highest) const;
  [[nodiscard]] int optional_int(std::string_view key, int fallback, int lowest, int highest) const;
  [[nodiscard]] double optional_number(std::string_view key, double fallback, double lowest,
                                       double highest) const;
  [[nodiscard]] std::string_view required_text(std::string_view key) const;
  [[nodiscard]] std::string_view optional_text(std::string_view key, std::string_view fallback) const;
  /// Numbers between commas; a comma too many at the end does no harm.
  [[nodiscard]] std::vector<double> required_numbers(std::string_view key, double lowest,
                                                     double highest) const;
  [[nodiscard]] std::vector<int> required_ints(std::string_view key, int lowest, int highest) const;

  /// Names the section's line, or the key's if there is one of that name.
  [[noreturn]] void fail(const std::string& what, std::string_view key = {}) const;

  void add(std::string_view key, std::string_view value, std::size_t line);

 private:
  struct Value {
    std::string text;
    std::size_t line;
  };
  [[nodiscard]] int to_int(std::string_view text, std::string_view key, int lowest, int highest) const;
  [[nodiscard]] double to_number(std::string_view text, std::string_view key, double lowest,
                                 double highest) const;

  std::string path_;
  std::size_t line_;
  std::string kind_;
  std::map<std::string, Value, std::less<>> values_;
};

/// Takes the text of a Darknet .cfg apart: "[kind]" lines, "key=value" lines, comments of '#' or ';', blanks
/// anywhere. path: for messages. Throws InputError naming file and line for what is none of these, for two
/// different values of one key, and when the file does not begin with [net].
[[nodiscard]] std::vector<DarknetSection> parse_darknet_config(const std::string& text,
                                                               const std::string& path);

}  // namespace cpslam
