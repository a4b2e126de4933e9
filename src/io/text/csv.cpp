#include "io/text/csv.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string_view>

#include "base/error.hpp"
#include "base/plain_text.hpp"
#include "io/text/input_text.hpp"

namespace perilink {
namespace {

constexpr std::size_t pending_limit = 64 * 1024;
constexpr std::size_t npos = std::string::npos;

/// Appends the shortest text that reads back as `value`. Whole numbers keep their digits: the
/// shortest text of 100000 would be 1e+05.
void append_number(std::string& text, double value) {
  constexpr double exact_integers = 9007199254740992.0;  // 2^53
  char buffer[32];
  const bool whole = std::trunc(value) == value && std::abs(value) < exact_integers &&
                     !(value == 0.0 && std::signbit(value));
  const auto result =
      whole ? std::to_chars(buffer, buffer + sizeof buffer, static_cast<std::int64_t>(value))
            : std::to_chars(buffer, buffer + sizeof buffer, value);
  text.append(buffer, result.ptr);
}

std::vector<std::string_view> split(std::string_view line) {
  std::vector<std::string_view> fields;
  for (;;) {
    const std::size_t comma = line.find(',');
    fields.push_back(line.substr(0, comma));
    if (comma == std::string_view::npos) return fields;
    line.remove_prefix(comma + 1);
  }
}

/// \param place  file, line and column, for messages
double parse_number(std::string_view field, const std::string& place) {
  field = trimmed(field);
  double value = 0.0;
  const auto [end, status] = std::from_chars(field.data(), field.data() + field.size(), value);
  const bool number = status == std::errc{} && end == field.data() + field.size();
  if (number && std::isfinite(value)) return value;
  if (field.empty()) throw FileError(place + " is empty where a number should be");
  throw FileError(place + " holds '" + printable(field) +
                  (number ? "', which is not finite" : "', which is not a number"));
}

std::vector<double> parse_row(const std::vector<std::string_view>& fields, const CsvTable& table,
                              EmptyCells empty, const std::string& place) {
  if (fields.size() != table.columns.size()) {
    throw FileError(fmt::format("{}: {}, but the header has {}", place,
                                counted(fields.size(), "field"), table.columns.size()));
  }
  std::vector<double> row;
  row.reserve(fields.size());
  for (std::size_t c = 0; c < fields.size(); ++c) {
    const bool unknown = empty == EmptyCells::unknown && trimmed(fields[c]).empty();
    row.push_back(
        unknown ? std::numeric_limits<double>::quiet_NaN()
                : parse_number(fields[c], fmt::format("{}: column {}", place, table.columns[c])));
  }
  return row;
}

void parse_header(const std::vector<std::string_view>& fields, CsvTable& table,
                  const std::string& place) {
  for (const std::string_view field : fields) {
    std::string name(trimmed(field));
    if (name.empty() || table.column(name) >= 0) {
      throw FileError(fmt::format("{}: column {} of the header {}", place, table.columns.size() + 1,
                                  name.empty() ? "has no name" : "has the name of another"));
    }
    table.columns.push_back(std::move(name));
  }
}

}  // namespace

CsvWriter::CsvWriter(const std::string& path, const std::vector<std::string>& columns)
    : file_(path), columns_(columns.size()) {
  for (std::size_t c = 0; c < columns.size(); ++c) {
    if (c > 0) pending_ += ',';
    pending_ += columns[c];
  }
  pending_ += '\n';
  flush();
}

CsvWriter::~CsvWriter() {
  try {
    flush();
  } catch (const FileError&) {
    // A destructor cannot throw; call flush() first to get errors.
  }
}

void CsvWriter::write_row(const std::vector<double>& values) {
  if (values.size() != columns_) {
    throw FileError(fmt::format("{}: row of {} numbers in a table of {} columns", file_.path(),
                                values.size(), columns_));
  }
  for (std::size_t c = 0; c < values.size(); ++c) {
    if (c > 0) pending_ += ',';
    append_number(pending_, values[c]);
  }
  pending_ += '\n';
  if (pending_.size() > pending_limit) flush();
}

void CsvWriter::flush() {
  if (!pending_.empty()) file_.append(pending_);
}

CsvRow& CsvRow::text(const std::string& value) {
  // A leading apostrophe keeps spreadsheets from reading the text as a formula.
  const bool formula = !value.empty() && std::string_view("=+-@\t\r").find(value[0]) != npos;
  const std::string text = printable((formula ? "'" : "") + value);
  const bool quote = formula || text.find_first_of(",\"\n") != npos;
  std::string field = quote ? "\"" : "";
  for (const char c : text) {
    if (c == '"') field += '"';
    field += c;
  }
  return append(quote ? field + '"' : field);
}

CsvRow& CsvRow::number(double value) {
  return append(std::isnan(value) ? "" : fmt::format("{}", value));
}

CsvRow& CsvRow::empty() { return append(""); }

CsvRow& CsvRow::append(const std::string& field) {
  if (!first_) line_ += ',';
  first_ = false;
  line_ += field;
  return *this;
}

std::vector<std::vector<std::string>> read_texts(const std::string& path) {
  std::vector<std::vector<std::string>> rows;
  bool quoted = false, begins = true;
  char before = 0;
  for (const char c : read_regular_file(path)) {
    if (begins) rows.push_back({""});
    begins = c == '\n' && !quoted;
    if (c == '"') {
      if (before == '"' && !quoted) rows.back().back() += c;  // two quotes are one
      quoted = !quoted;
    } else if (c == ',' && !quoted) {
      rows.back().emplace_back();
    } else if (!begins) {
      rows.back().back() += c;
    }
    before = c;
  }
  return rows;
}

int CsvTable::column(const std::string& name) const {
  const auto found = std::find(columns.begin(), columns.end(), name);
  return found == columns.end() ? -1 : static_cast<int>(found - columns.begin());
}

CsvTable read_csv(const std::string& path, EmptyCells empty) {
  const std::string text = read_regular_file(path);
  std::string_view rest = text;
  CsvTable table;
  for (int number = 1; !rest.empty(); ++number) {
    const std::size_t end = rest.find('\n');
    // A number in a row without its end may have lost digits.
    if (end == std::string_view::npos) {
      table.cut_off = true;
      break;
    }
    const std::string_view line = trimmed(rest.substr(0, end));
    rest.remove_prefix(end + 1);
    if (line.empty()) continue;
    const std::string place = path + ":" + std::to_string(number);
    if (table.columns.empty()) {
      parse_header(split(line), table, place);
    } else {
      table.rows.push_back(parse_row(split(line), table, empty, place));
    }
  }
  if (table.columns.empty()) throw FileError(path + ": empty, a header row is expected");
  return table;
}

}  // namespace perilink
