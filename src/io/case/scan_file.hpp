#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "io/case/case_settings.hpp"

/// \file The scan file: a case and the values with which it is run. docs/studies.md is the user's
///     page.

namespace perilink {

/// One run of a scan.
struct ScanMember {
  std::vector<CaseSetting> settings;  ///< with the lines of the scan file
  int line = 0;                       ///< in the scan file

  /// Returns the value of a key; nullptr where the case keeps its own.
  const TomlValue* find(const std::string& key) const;
};

/// A whole scan.
struct ScanFile {
  std::string path;
  std::string title;
  std::string case_path;  ///< relative to the working directory; without a file a name
  std::optional<std::string> case_text = {};  ///< of a case without a file
  std::vector<std::string> keys;              ///< as written, in the order of the file
  std::vector<ScanMember> members;
  std::vector<int> seeds;  ///< of the case's [[random]] and [body]; empty: of the case
  int seeds_line = 0;      ///< in the scan file
};

/// Runs each member once for every seed, which varies fastest. Every `seed` of the case's
/// [[random]] and of unstructured particles gets it; seeds that differ in the case stay different.
/// \param document  of the case
/// \throws InputError  where a member has neither
void give_seeds(ScanFile& scan, const TomlValue& document);

/// Returns whether a key of a member is a seed given by give_seeds().
bool is_seed(const ScanFile& scan, const std::string& key);

/// Reads and checks a scan; the case itself is not opened.
/// \throws InputError  with file, line, key, value given, what is allowed and a suggestion
/// \throws FileError   when the file cannot be read
ScanFile read_scan_file(const std::string& path);

/// Reads and checks a scan from text.
ScanFile parse_scan(const std::string& text, const std::string& path);

/// Describes a member, "body.spacing = 0.5, title = a".
std::string member_text(std::span<const CaseSetting> settings);

/// Returns a value as in tables: text without quotes.
std::string value_text(const TomlValue& value);

}  // namespace perilink
