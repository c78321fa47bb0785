#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace cpslam {

/// A finite number that fills the whole text ("1e-3", "+4", not "4px", not "nan"); independent of the locale.
[[nodiscard]] std::optional<double> parse_number(std::string_view text);

/// A time stamp as all files of ours have it: seconds with six digits.
[[nodiscard]] std::string stamp_text(double time_s);

/// A piece of a file as it may stand in a one-line message: shortened, control characters replaced.
[[nodiscard]] std::string printable(std::string_view text);

/// Reads a text file of rows whose fields stand between blanks, tabs or commas. Empty lines and what follows
/// a
/// '#' that starts a field are left out. Errors are InputErrors of the form "file:line: what".
class TextTable {
 public:
  explicit TextTable(const std::string& path);

  /// Goes to the next row with a field; false at the end.
  bool next_row();
  [[nodiscard]] const std::vector<std::string_view>& fields() const { return fields_; }

  /// The current row must have this many fields; `form` says what they are.
  void expect_fields(std::size_t count, std::string_view form) const;
  [[nodiscard]] double number(std::size_t field) const;
  [[nodiscard]] std::string text(std::size_t field) const { return std::string(fields_[field]); }
  [[noreturn]] void fail(const std::string& what) const;
  /// For what is wrong with the file as a whole.
  [[noreturn]] void fail_file(const std::string& what) const;

 private:
  void split(std::string_view line);

  std::string path_;
  std::string content_;
  std::size_t position_ = 0;
  std::size_t line_ = 0;
  std::vector<std::string_view> fields_;
};

}  // namespace cpslam
