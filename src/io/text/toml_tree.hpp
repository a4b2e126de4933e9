#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

/// \file The TOML document as plain data. parse_toml hides toml++, which is slow to compile; the
///     reader of cases needs only values and their lines.

namespace perilink {

/// Line of values that the option --set gives.
inline constexpr int from_option = -1;

/// One value with the line of its key.
struct TomlValue {
  enum class Kind { boolean, integer, number, text, date, array, table };

  Kind kind = Kind::table;
  int line = 0;  ///< one-based; 0 for values of studies, from_option for those of --set
  bool boolean = false;
  std::int64_t integer = 0;
  double number = 0.0;  ///< set for integers too
  std::string text;
  std::string key;                 ///< name of an entry of a table
  std::vector<TomlValue> items;    ///< values in an array
  std::vector<TomlValue> entries;  ///< entries in a table, in the file's order

  /// Returns the value of a key of a table, or nullptr.
  const TomlValue* find(const std::string& name) const;
  TomlValue* find(const std::string& name) {
    return const_cast<TomlValue*>(std::as_const(*this).find(name));
  }
};

/// Reads a document.
/// \param path  only named in messages
/// \throws InputError  where the text is not TOML, or nested too deep
TomlValue parse_toml(const std::string& text, const std::string& path);

/// Describes type and value for messages: `the integer 3`, `an array of 2 values`.
std::string describe(const TomlValue& value);

/// Returns the value as TOML text on one line, which reads back to an equal value; dates are lost.
std::string toml_text(const TomlValue& value);

/// Returns text in quotes for messages: one line, printable, cut where it is long.
std::string quoted(const std::string& text);

}  // namespace perilink
