#pragma once

#include <cstdio>
#include <string>
#include <vector>

namespace perilink {

/// Comma-separated table that grows row by row. Numbers are written with the fewest digits that
/// read back exactly, independent of the locale. Only whole rows reach the file, so that a killed
/// run leaves a readable table: rows wait in memory until flush(), the destructor or 64 KiB.
class CsvWriter {
 public:
  CsvWriter(const std::string& path, const std::vector<std::string>& columns);
  ~CsvWriter();
  CsvWriter(const CsvWriter&) = delete;
  CsvWriter& operator=(const CsvWriter&) = delete;

  void write_row(const std::vector<double>& values);
  void flush();

 private:
  std::FILE* file_;
  std::string path_;
  std::size_t columns_;
  std::string pending_;  ///< whole rows that are not in the file yet
};

/// A row of a table that holds texts too; texts with commas, quotes or line ends are quoted.
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

  /// Column number, or -1.
  int column(const std::string& name) const;
};

/// Reads a table of numbers with a header row; an empty field is not-a-number. A last row without
/// its line end and with too few fields is what a killed writer left, and is dropped.
/// \throws FileError
CsvTable read_csv(const std::string& path);

}  // namespace perilink
