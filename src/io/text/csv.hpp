#pragma once

#include <string>
#include <vector>

#include "base/files.hpp"

namespace perilink {

/// Comma-separated table that grows row by row. Numbers are written with the fewest digits that
/// read back exactly, independent of the locale. Rows are buffered until flush(), the destructor or
/// 64 KiB. Only whole rows are written (LineFile); on a full disk, as many as fit.
class CsvWriter {
 public:
  /// \throws FileError
  CsvWriter(const std::string& path, const std::vector<std::string>& columns);
  /// Goes on with an existing table.
  /// \param size  bytes of the table to keep; the rest is removed
  /// \throws FileError
  CsvWriter(const std::string& path, const std::vector<std::string>& columns, std::size_t size)
      : file_(path, size), columns_(columns.size()) {}
  ~CsvWriter();
  CsvWriter(const CsvWriter&) = delete;
  CsvWriter& operator=(const CsvWriter&) = delete;

  /// \throws FileError
  void write_row(const std::vector<double>& values);
  /// \throws FileError
  void flush();
  std::size_t size() const { return file_.size(); }  ///< of the rows that are flushed [bytes]

 private:
  LineFile file_;
  std::size_t columns_;
  std::string pending_;  ///< whole rows not yet written
};

/// A row of a table of texts and numbers. Texts with commas, quotes or line ends are quoted. A text
/// that begins like a formula of a spreadsheet (= + - @) gets a leading apostrophe. Characters that
/// are not printable() are escaped.
class CsvRow {
 public:
  CsvRow& text(const std::string& value);
  /// Appends a number; not-a-number gives an empty field.
  CsvRow& number(double value);
  CsvRow& empty();
  /// Returns the row with its line end.
  std::string end() const { return line_ + "\n"; }

 private:
  CsvRow& append(const std::string& field);

  std::string line_;
  bool first_ = true;
};

/// Reads the fields of CsvRow's rows, without quotes. \throws FileError
std::vector<std::vector<std::string>> read_texts(const std::string& path);

/// A table of numbers that was read.
struct CsvTable {
  std::vector<std::string> columns;
  std::vector<std::vector<double>> rows;
  bool cut_off = false;  ///< the last row had no line end and was left out

  /// Returns the number of a column, or -1.
  int column(const std::string& name) const;
};

/// Treatment of empty cells: a fault, or an unknown number (NaN).
enum class EmptyCells { refused, unknown };

/// Reads a table of finite numbers with a header row. A last row without its line end, from an
/// interrupted writer, is dropped.
/// \throws FileError with file, line and column
CsvTable read_csv(const std::string& path, EmptyCells empty = EmptyCells::refused);

}  // namespace perilink
