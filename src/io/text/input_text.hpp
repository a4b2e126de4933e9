#pragma once

#include <string>
#include <string_view>

/// \file The text of cases and studies.

namespace perilink {

/// Reads a file. Where the file is too large, only the bytes that refuse_large_input() needs are
/// read.
/// \throws FileError when the file cannot be read
std::string read_input_text(const std::string& path);

/// Refuses a text too large for a case: a mesh or an image named by mistake.
/// \param path  only named in the message
/// \throws InputError
void refuse_large_input(const std::string& text, const std::string& path);

/// Turns a path relative to the folder of a file into one relative to the working directory.
std::string beside(const std::string& file, const std::string& path);

/// Returns text without leading and trailing blanks and line ends.
std::string_view trimmed(std::string_view text);

}  // namespace perilink
