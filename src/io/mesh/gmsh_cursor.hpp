#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace perilink {

/// Reads the values of a .msh file, text or binary, one after the other. Every reader throws
/// InputError with file and line where the value is missing or out of range.
class GmshCursor {
 public:
  /// \param bytes  must outlive this object
  GmshCursor(std::string_view bytes, std::string path) : bytes_(bytes), path_(std::move(path)) {}

  const std::string& path() const { return path_; }

  void set_binary(bool binary) { binary_ = binary; }
  bool binary() const { return binary_; }
  bool at_end();

  /// Reads a line of text without its end, also in binary files, whose headers are text.
  std::string_view line();
  /// Reads a word of text up to the next blank.
  std::string_view word();
  /// Reads a number written as text, also in binary files.
  std::int64_t text_integer();

  int integer();        ///< gmsh's int
  std::int64_t size();  ///< gmsh's size_t, at most 2^63 - 1
  double number();      ///< finite
  /// Reads the number of items that follow. Refuses numbers larger than the rest of the file can
  /// hold, so that memory can be reserved.
  /// \param values_each  least number of values per item; 0 means 1
  std::size_t count(std::size_t values_each, const char* things) {
    return checked_count(size(), values_each, things);
  }
  /// Reads a line with such a number, which is text also in binary files.
  std::size_t count_line(std::size_t values_each, const char* things);

  /// Skips to the line after "$End<section>".
  void skip_to_end_of(std::string_view section);
  /// Reads the line "$End<section>", which must come next.
  void expect_end_of(std::string_view section);

  [[noreturn]] void refuse(const std::string& fault, const std::string& advice = "") const;

 private:
  std::size_t checked_count(std::int64_t value, std::size_t values_each, const char* things) const;
  void skip_blanks();
  template <class Value>
  Value raw();

  std::string_view bytes_;
  std::string path_;
  std::size_t at_ = 0;
  bool binary_ = false;
};

}  // namespace perilink
