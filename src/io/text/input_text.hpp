#pragma once

#include <string>
#include <string_view>

/// \file
/// The text of files that people write: cases and studies.

namespace perilink {

/// Reads a file, of one that is too large only as much as refuse_large_input needs.
/// \throws FileError when the file cannot be read
std::string read_input_text(const std::string& path);

/// Refuses a text that nobody writes by hand: a mesh or an image named by mistake.
/// \param path  only named in the message
/// \throws InputError
void refuse_large_input(const std::string& text, const std::string& path);

/// Text without the blanks and line ends around it.
std::string_view trimmed(std::string_view text);

}  // namespace perilink
