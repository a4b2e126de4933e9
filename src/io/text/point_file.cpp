#include "io/text/point_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <iterator>
#include <limits>
#include <string_view>

#include "base/error.hpp"
#include "base/files.hpp"
#include "base/plain_text.hpp"
#include "io/text/input_text.hpp"

namespace perilink {
namespace {

constexpr double memory_per_table_byte = 4.0;  // of the points and their search, beside the text
constexpr double largest_in_table = 1e50;      // as in a case
constexpr std::size_t longest_shown = 80;      // characters of a text in messages
constexpr std::string_view utf8_mark = "\xef\xbb\xbf";

/// Places of the needed columns in a row.
struct PointColumns {
  std::vector<std::string> needed;  ///< coordinates, then the values
  std::vector<std::size_t> place;   ///< per needed column
  std::size_t count = 0;            ///< columns of the file
};

/// Splits a line at its commas into the fields.
void split_fields(std::string_view line, std::vector<std::string_view>& fields) {
  fields.clear();
  for (;;) {
    const std::size_t comma = line.find(',');
    fields.push_back(trimmed(line.substr(0, comma)));
    if (comma == std::string_view::npos) return;
    line.remove_prefix(comma + 1);
  }
}

/// Returns the name of a column without the quotes that R writes.
std::string_view unquoted(std::string_view name) {
  const bool quoted = name.size() >= 2 && name.front() == '"' && name.back() == '"';
  return quoted ? name.substr(1, name.size() - 2) : name;
}

std::string example_of(const PointColumns& columns) {
  std::string header;
  for (const std::string& name : columns.needed) header += (header.empty() ? "" : ",") + name;
  return header;
}

/// Finds the needed columns in a header, which may begin with "#" as numpy.savetxt writes it.
void read_point_header(std::string_view line, PointColumns& columns, const SourceLocation& where) {
  if (line.starts_with('#')) line.remove_prefix(1);
  std::vector<std::string_view> names;
  split_fields(line, names);
  std::ranges::transform(names, names.begin(), unquoted);
  columns.count = names.size();
  const auto is_named = [&](std::string_view name) { return std::ranges::count(names, name); };
  for (const std::string& name : columns.needed) {
    const auto found = std::ranges::find(names, name);
    if (found == names.end()) {
      throw InputError(where,
                       fmt::format("has the header '{}' without the column {}",
                                   printable(line.substr(0, longest_shown)), name),
                       fmt::format("the first line names the columns, separated by commas: {}{}",
                                   example_of(columns),
                                   name == columns.needed.back()
                                       ? "; `column` in the case names another one for the factors"
                                       : ""));
    }
    if (is_named(name) > 1) {
      throw InputError(where, fmt::format("has {} columns with the name {}", is_named(name), name),
                       "delete all but one");
    }
    columns.place.push_back(static_cast<std::size_t>(found - names.begin()));
  }
  if (columns.needed.size() == 3 && is_named("z") > 0) {
    throw InputError(
        where, "has a column z, but the body is two-dimensional",
        fmt::format("keep the points of one plane, without z: {}", example_of(columns)));
  }
}

/// Refuses a number that is out of range or none.
[[noreturn]] void refuse_point(std::string_view field, bool is_value, const SourceLocation& where) {
  const char* allowed =
      is_value ? "write positive numbers up to 1e50" : "write numbers between -1e50 and 1e50";
  if (field.empty()) throw InputError(where, "is empty", allowed);
  double ignored = 0.0;
  const auto [end, status] = std::from_chars(field.data(), field.data() + field.size(), ignored);
  const bool is_number = end == field.data() + field.size();
  throw InputError(where,
                   fmt::format("is '{}'{}", printable(field.substr(0, longest_shown)),
                               is_number ? "" : ", which is not a number"),
                   allowed);
}

/// Appends the numbers of a row. \throws InputError
void read_point(const std::vector<std::string_view>& fields, const PointColumns& columns,
                const std::string& path, int line, PointValues& points) {
  if (fields.size() != columns.count) {
    throw InputError({path, line, ""},
                     fmt::format("has {}, but the header names {}",
                                 counted(std::ssize(fields), "field"), columns.count),
                     "write a number per column, with a decimal point, separated by commas");
  }
  for (std::size_t k = 0; k < columns.needed.size(); ++k) {
    const std::string_view field = fields[columns.place[k]];
    const bool is_value = k + 1 == columns.needed.size();
    double number = 0.0;
    const char* end = field.data() + field.size();
    const auto [read, status] = std::from_chars(field.data(), end, number);
    const bool fits = std::abs(number) <= largest_in_table && (!is_value || number > 0.0);
    if (status != std::errc{} || read != end || !fits) {
      refuse_point(field, is_value, {path, line, columns.needed[k]});
    }
    (is_value ? points.values : points.positions).push_back(number);
  }
  points.lines.push_back(line);
}

PointColumns needed_columns(int dim, const std::string& column) {
  PointColumns columns;
  for (const char axis : std::string_view("xyz").substr(0, static_cast<std::size_t>(dim))) {
    columns.needed.emplace_back(1, axis);
  }
  columns.needed.push_back(column);
  return columns;
}

}  // namespace

PointValues read_point_file(const std::string& path, int dim, const std::string& column) {
  const std::string text =
      read_regular_file(path, std::numeric_limits<std::size_t>::max(), memory_per_table_byte);
  std::string_view rest = text;
  if (rest.starts_with(utf8_mark)) rest.remove_prefix(utf8_mark.size());
  PointColumns columns = needed_columns(dim, column);
  PointValues points;
  std::vector<std::string_view> fields;
  for (int line = 1; !rest.empty(); ++line) {
    const std::size_t end = std::min(rest.find('\n'), rest.size());
    const std::string_view row = trimmed(rest.substr(0, end));
    rest.remove_prefix(std::min(end + 1, rest.size()));
    if (row.empty()) continue;
    if (columns.count == 0) {
      read_point_header(row, columns, {path, line, ""});
      continue;
    }
    split_fields(row, fields);
    read_point(fields, columns, path, line, points);
  }
  const SourceLocation file{path, 0, ""};
  if (columns.count == 0) {
    throw InputError(file, "is empty",
                     fmt::format("write the header {} and a row per point", example_of(columns)));
  }
  if (points.values.size() < 2) {
    throw InputError(file, fmt::format("has {}", counted(std::ssize(points.values), "point")),
                     "give at least two; a constant factor needs no file: factor = 1.2");
  }
  return points;
}

}  // namespace perilink
