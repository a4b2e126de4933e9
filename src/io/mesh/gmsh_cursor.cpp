#include "io/mesh/gmsh_cursor.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstring>
#include <limits>

#include "base/error.hpp"
#include "io/mesh/mesh_listing.hpp"
#include "io/text/toml_tree.hpp"

namespace perilink {
namespace {

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }

}  // namespace

void GmshCursor::refuse(const std::string& fault, const std::string& advice) const {
  const std::string_view read = bytes_.substr(0, at_);
  const auto lines = binary_ ? 0 : 1 + std::count(read.begin(), read.end(), '\n');
  throw InputError({path_, static_cast<int>(std::min<std::ptrdiff_t>(lines, 1 << 30)), ""}, fault,
                   advice);
}

void GmshCursor::skip_blanks() {
  while (at_ < bytes_.size() && is_blank(bytes_[at_])) ++at_;
}

bool GmshCursor::at_end() {
  skip_blanks();
  return at_ == bytes_.size();
}

std::string_view GmshCursor::line() {
  const std::size_t end = std::min(bytes_.find('\n', at_), bytes_.size());
  std::string_view text = bytes_.substr(at_, end - at_);
  at_ = std::min(end + 1, bytes_.size());
  if (!text.empty() && text.back() == '\r') text.remove_suffix(1);
  return text;
}

std::string_view GmshCursor::word() {
  skip_blanks();
  const std::size_t begin = at_;
  while (at_ < bytes_.size() && !is_blank(bytes_[at_])) ++at_;
  if (begin == at_) refuse("the file ends too early", "write the mesh again");
  return bytes_.substr(begin, at_ - begin);
}

std::int64_t GmshCursor::text_integer() {
  const std::string_view text = word();
  std::int64_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) {
    refuse(fmt::format("has {} where an integer should be", quoted(std::string(text))));
  }
  return value;
}

template <class Value>
Value GmshCursor::raw() {
  Value value{};
  if (bytes_.size() - at_ < sizeof value) {
    refuse("the file ends too early", "write the mesh again");
  }
  std::memcpy(&value, bytes_.data() + at_, sizeof value);
  at_ += sizeof value;
  return value;
}

int GmshCursor::integer() {
  if (binary_) return raw<std::int32_t>();
  const std::int64_t value = text_integer();
  if (value < std::numeric_limits<int>::min() || value > std::numeric_limits<int>::max()) {
    refuse(fmt::format("has the integer {}, which is too large", value));
  }
  return static_cast<int>(value);
}

std::int64_t GmshCursor::size() {
  const std::int64_t value = binary_ ? raw<std::int64_t>() : text_integer();
  if (value < 0) refuse("has a negative or huge number where a count or a tag should be");
  return value;
}

double GmshCursor::number() {
  double value = 0.0;
  if (binary_) {
    value = raw<double>();
  } else {
    const std::string_view text = word();
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error == std::errc::result_out_of_range) {
      refuse(fmt::format("has {}, a number that double precision does not hold",
                         quoted(std::string(text))),
             "the file is damaged, or needs other units: write the mesh again");
    } else if (error != std::errc() || end != text.data() + text.size()) {
      refuse(fmt::format("has {} where a number should be", quoted(std::string(text))));
    }
  }
  if (!(std::abs(value) <= largest_coordinate)) {
    refuse(fmt::format("has the coordinate {}, which is not finite or too large", value));
  }
  return value;
}

std::size_t GmshCursor::count_line(std::size_t values_each, const char* things) {
  const std::size_t value = checked_count(text_integer(), values_each, things);
  line();
  return value;
}

std::size_t GmshCursor::checked_count(std::int64_t value, std::size_t values_each,
                                      const char* things) const {
  // As text, each value takes at least a digit and a blank; the file may end after the last digit.
  const std::size_t least = std::max<std::size_t>(values_each, 1) * (binary_ ? 4 : 2);
  const std::size_t left = bytes_.size() - at_ + 1;
  if (value < 0 || static_cast<std::uint64_t>(value) > left / least) {
    refuse(fmt::format("announces {} {}, more than the rest of the file can hold", value, things),
           "the file is cut off or damaged: write the mesh again");
  }
  return static_cast<std::size_t>(value);
}

void GmshCursor::skip_to_end_of(std::string_view section) {
  const std::string mark = fmt::format("$End{}", section);
  const std::size_t found = bytes_.find(mark, at_);
  if (found == std::string_view::npos) {
    refuse(fmt::format("has ${} without {}", section, mark),
           "the file is cut off: write the mesh again");
  }
  at_ = found + mark.size();
}

void GmshCursor::expect_end_of(std::string_view section) {
  const std::string_view found = at_end() ? std::string_view("the end of the file") : word();
  if (found == fmt::format("$End{}", section)) return;
  refuse(fmt::format("has {} where $End{} should be", quoted(std::string(found)), section),
         "the file is cut off or damaged: write the mesh again");
}

}  // namespace perilink
