#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace perilink {

/// Reads the values of a .msh file one after the other, written as text or in binary. Every reader
/// throws InputError with file and line where the value is missing or out of range.
class GmshCursor {
 public:
  /// \param bytes  must outlive this object
  GmshCursor(std::string_view bytes, std::string path) : bytes_(bytes), path_(std::move(path)) {}

  const std::string& path() const { return path_; }

  void set_binary(bool binary) { binary_ = binary; }
  bool at_end();

  /// A line of text, without its end; also in binary files, whose headers are text.
  std::string_view line();
  /// A word of text up to the next blank.
  std::string_view word();
  /// A number written as text, also in binary files.
  std::int64_t text_integer();

  int integer();        ///< gmsh's int
  std::int64_t size();  ///< gmsh's size_t, at most 2^63 - 1
  double number();      ///< finite
  /// A number of things to come. It is refused where the rest of the file cannot hold them, so that
  /// memory may be reserved for it.
  /// \param values_each  numbers of each of the things, at least; none counts as one
  std::size_t count(std::size_t values_each, const char* things);

  /// Goes behind the line "$End<section>".
  void skip_to_end_of(std::string_view section);
  /// Expects that line to be the next thing.
  void expect_end_of(std::string_view section);

  [[noreturn]] void refuse(const std::string& fault, const std::string& advice = "") const;

 private:
  void skip_blanks();
  template <class Value>
  Value raw();

  std::string_view bytes_;
  std::string path_;
  std::size_t at_ = 0;
  bool binary_ = false;
};

}  // namespace perilink
