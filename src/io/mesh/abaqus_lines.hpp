#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace perilink {

/// Keyword line of an input file of Abaqus.
struct AbaqusKeyword {
  std::string name;                               ///< upper case: "ELEMENT"
  std::map<std::string, std::string> parameters;  ///< names in upper case; values may be empty

  bool has(const std::string& parameter) const { return parameters.count(parameter) > 0; }
  /// Returns the value of a parameter, empty where it is missing.
  std::string value(const std::string& parameter) const;
};

/// Returns a text in upper case, in which Abaqus compares names.
std::string upper(std::string_view text);

/// Reads an input file of Abaqus line by line, without comments and empty lines.
class AbaqusLines {
 public:
  /// \param bytes  must outlive this object
  AbaqusLines(std::string_view bytes, std::string path) : rest_(bytes), path_(std::move(path)) {}

  /// Skips data lines and reads the next keyword; none at the end of the file.
  std::optional<AbaqusKeyword> next_keyword();
  /// Reads the entries of the next data line; none before a keyword or the end of the file.
  std::optional<std::vector<std::string_view>> next_data();

  /// Returns an entry as a number or label; refuses others.
  double number(std::string_view entry) const;
  std::int64_t label(std::string_view entry) const;
  /// Whether an entry is a label and not a name.
  static bool is_label(std::string_view entry);

  int line() const { return line_; }  ///< line that was read last
  [[noreturn]] void refuse(const std::string& fault, const std::string& advice) const;

 private:
  std::optional<std::string_view> peek();

  std::string_view rest_, next_;  ///< unread lines, and the next line where `peeked_`
  std::string path_;
  int line_ = 0;
  bool peeked_ = false;
};

}  // namespace perilink
