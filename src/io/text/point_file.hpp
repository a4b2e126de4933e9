#pragma once

#include <string>
#include <vector>

namespace perilink {

/// Values at points, from a table of a file.
struct PointValues {
  std::vector<double> positions;  ///< shape (points, dim) [length]
  std::vector<double> values;     ///< per point, positive
  std::vector<int> lines;         ///< line of the file per point, from one
};

/// Reads positive values at points from comma-separated text: a header that names the columns, then
/// a row per point. Further columns are ignored.
/// \param dim     2: columns x and y; 3: also z
/// \param column  name of the column of values
/// \throws InputError with file, line and column; FileError where the file cannot be read
PointValues read_point_file(const std::string& path, int dim, const std::string& column);

}  // namespace perilink
