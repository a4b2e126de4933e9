#include "io/csv.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <iterator>
#include <limits>
#include <string_view>

#include "base/error.hpp"

namespace perilink {
namespace {

constexpr std::size_t pending_limit = 64 * 1024;

/// Shortest text that reads back as `value`. Whole numbers keep their digits: shortest alone would
/// write 100000 as 1e+05.
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

std::string_view trim(std::string_view text) {
  constexpr std::string_view blanks = " \t\r";
  const std::size_t begin = text.find_first_not_of(blanks);
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(blanks) - begin + 1);
}

double parse_number(std::string_view field, const std::string& place) {
  field = trim(field);
  if (field.empty()) return std::numeric_limits<double>::quiet_NaN();
  double value = 0.0;
  const auto [end, status] = std::from_chars(field.data(), field.data() + field.size(), value);
  if (status != std::errc{} || end != field.data() + field.size()) {
    throw FileError(place + ": '" + std::string(field) + "' is not a number");
  }
  return value;
}

std::string read_text(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw FileError(path + ": cannot be read: " + std::strerror(errno));
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

}  // namespace

CsvWriter::CsvWriter(const std::string& path, const std::vector<std::string>& columns)
    : file_(std::fopen(path.c_str(), "wb")), path_(path), columns_(columns.size()) {
  if (!file_) throw FileError(path_ + ": cannot be written: " + std::strerror(errno));
  // The rows are collected here; a second buffer could end in the middle of one.
  std::setvbuf(file_, nullptr, _IONBF, 0);
  for (std::size_t c = 0; c < columns.size(); ++c) {
    if (c > 0) pending_ += ',';
    pending_ += columns[c];
  }
  pending_ += '\n';
  try {
    flush();
  } catch (...) {
    std::fclose(file_);
    throw;
  }
}

CsvWriter::~CsvWriter() {
  try {
    flush();
  } catch (const FileError&) {
    // A destructor cannot report; callers that care call flush() before.
  }
  std::fclose(file_);
}

void CsvWriter::write_row(const std::vector<double>& values) {
  if (values.size() != columns_) {
    throw FileError(path_ + ": row of " + std::to_string(values.size()) +
                    " numbers in a table of " + std::to_string(columns_) + " columns");
  }
  for (std::size_t c = 0; c < values.size(); ++c) {
    if (c > 0) pending_ += ',';
    append_number(pending_, values[c]);
  }
  pending_ += '\n';
  if (pending_.size() > pending_limit) flush();
}

void CsvWriter::flush() {
  const std::size_t written = std::fwrite(pending_.data(), 1, pending_.size(), file_);
  const bool failed = written != pending_.size();
  pending_.erase(0, written);
  if (failed) throw FileError(path_ + ": cannot be written: " + std::strerror(errno));
}

CsvRow& CsvRow::text(const std::string& value) {
  const bool quote = value.find_first_of(",\"\n\r") != std::string::npos;
  std::string field = quote ? "\"" : "";
  for (const char c : value) {
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

int CsvTable::column(const std::string& name) const {
  const auto found = std::find(columns.begin(), columns.end(), name);
  return found == columns.end() ? -1 : static_cast<int>(found - columns.begin());
}

CsvTable read_csv(const std::string& path) {
  const std::string text = read_text(path);
  std::string_view rest = text;
  CsvTable table;
  for (int number = 1; !rest.empty(); ++number) {
    const std::size_t end = rest.find('\n');
    const std::string_view line = trim(rest.substr(0, end));
    const bool last_and_open = end == std::string_view::npos;
    rest.remove_prefix(last_and_open ? rest.size() : end + 1);
    if (line.empty()) continue;

    const std::string place = path + ":" + std::to_string(number);
    const std::vector<std::string_view> fields = split(line);
    if (table.columns.empty()) {
      for (std::string_view field : fields) table.columns.emplace_back(trim(field));
      continue;
    }
    if (fields.size() != table.columns.size()) {
      if (last_and_open && fields.size() < table.columns.size()) break;
      throw FileError(place + ": " + std::to_string(fields.size()) +
                      " fields, but the header has " + std::to_string(table.columns.size()));
    }
    std::vector<double> row;
    row.reserve(fields.size());
    for (std::string_view field : fields) row.push_back(parse_number(field, place));
    table.rows.push_back(std::move(row));
  }
  if (table.columns.empty()) throw FileError(path + ": empty, a header row is expected");
  return table;
}

}  // namespace perilink
