#pragma once

#include <cstdio>
#include <initializer_list>
#include <string>
#include <vector>

namespace perilink {

/// Comma-separated table that grows row by row. Numbers are written with the fewest digits that read
/// back exactly, independent of the locale. Every row is flushed at once when `flush_rows` is set, so
/// that a killed run leaves whole rows.
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
};

/// A table read back.
struct CsvTable {
  std::vector<std::string> columns;
  std::vector<std::vector<double>> rows;

  /// Column number, or -1.
  int column(const std::string& name) const;
};

/// \throws FileError
CsvTable read_csv(const std::string& path);

}  // namespace perilink
