#pragma once

#include <string>
#include <vector>

#include "base/files.hpp"

namespace perilink {

/// Comma-separated table that grows row by row. Numbers are written with the fewest digits that
/// read back exactly, independent of the locale. Whole rows go to the file (LineFile), on a full
/// disk as many as fit: rows wait in memory until flush(), the destructor or 64 KiB.
class CsvWriter {
 public:
  /// \throws FileError
  CsvWriter(const std::string& path, const std::vector<std::string>& columns);
  ~CsvWriter();
  CsvWriter(const CsvWriter&) = delete;
  CsvWriter& operator=(const CsvWriter&) = delete;

  /// \throws FileError
  void write_row(const std::vector<double>& values);
  /// \throws FileError
  void flush();
  /// Flushes and waits until the disk has it all. \throws FileError
  void finish();

 private:
  LineFile file_;
  std::size_t columns_;
  std::string pending_;  ///< whole rows that are not in the file yet
};

/// A row of a table that holds texts too; texts with commas, quotes or line ends are quoted. A text
/// that begins like a formula of a spreadsheet (= + - @) gets an apostrophe before it, and what is
/// not printable() is written out.
class CsvRow {
 public:
  CsvRow& text(const std::string& value);
  /// Not-a-number is an empty field.
  CsvRow& number(double value);
  CsvRow& empty();
  /// The row with its line end.
  std::string end() const { return line_ + "\n"; }

 private:
  CsvRow& append(const std::string& field);

  std::string line_;
  bool first_ = true;
};

/// A table read back.
struct CsvTable {
  std::vector<std::string> columns;
  std::vector<std::vector<double>> rows;
  bool cut_off = false;  ///< the last row had no line end and was left out

  /// Column number, or -1.
  int column(const std::string& name) const;
};

/// What an empty cell of a table is: a fault, or a number that nobody has (NaN).
enum class EmptyCells { refused, unknown };

/// Reads a table of finite numbers with a header row. A last row without its line end is what a
/// killed writer left, and is dropped.
/// \throws FileError with file, line and column
CsvTable read_csv(const std::string& path, EmptyCells empty = EmptyCells::refused);

}  // namespace perilink
