#pragma once

#include <cstdint>
#include <string>
#include <vector>

/// \file
/// The TOML document as plain data. toml++ stays behind parse_toml: it is slow to compile, and the
/// reader of cases needs of it only values and the lines that they stand on.

namespace perilink {

/// One value with the line of its key.
struct TomlValue {
  enum class Kind { boolean, integer, number, text, date, array, table };

  Kind kind = Kind::table;
  int line = 0;  ///< one-based
  bool boolean = false;
  std::int64_t integer = 0;
  double number = 0.0;  ///< set for integers too
  std::string text;
  std::string key;                 ///< name of an entry of a table
  std::vector<TomlValue> items;    ///< values in an array
  std::vector<TomlValue> entries;  ///< entries in a table, in the file's order

  /// Value of a key of a table, or nullptr.
  const TomlValue* find(const std::string& name) const;
};

/// Reads a document.
/// \param path  only named in messages
/// \throws InputError  where the text is not TOML, or nested deeper than any case can be
TomlValue parse_toml(const std::string& text, const std::string& path);

/// What a value is and says, for messages: `the integer 3`, `an array of 2 values`.
std::string describe(const TomlValue& value);

/// Text between quotes as a message can carry it: one line, printable, cut where it is long.
std::string quoted(const std::string& text);

}  // namespace perilink
