#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

/// \file
/// Writes VTK unstructured grids (.vtu, XML, zlib-compressed inline binary) and time series (.pvd),
/// as ParaView opens them, and reads files that this program wrote.

namespace perilink {

/// Named numbers per point or cell.
struct VtuArray {
  std::string name;
  int components = 1;
  std::vector<double> values;  ///< shape (points or cells, components)
};

/// VTK cell types used here.
enum class VtuCell : std::uint8_t {
  vertex = 1,
  line = 3,
  triangle = 5,
  quadrilateral = 9,
  tetrahedron = 10,
  hexahedron = 12,
};

/// An unstructured grid.
struct VtuGrid {
  std::vector<double> points;              ///< shape (n, 3) [length]
  std::vector<VtuCell> types;              ///< per cell
  std::vector<std::int32_t> connectivity;  ///< point numbers, cell after cell
  std::vector<std::int32_t> offsets;       ///< end of each cell in connectivity
  std::vector<VtuArray> point_data;
  std::vector<VtuArray> cell_data;
  std::vector<std::pair<std::string, double>> field_data;  ///< single numbers: load factor, step

  const VtuArray* find_point_data(const std::string& name) const;
  const VtuArray* find_cell_data(const std::string& name) const;
  double field(const std::string& name, double otherwise) const;
};

/// \throws FileError
void write_vtu(const std::string& path, const VtuGrid& grid);

/// Reads a file written by write_vtu.
/// \throws FileError naming the file and what is wrong with it
VtuGrid read_vtu(const std::string& path);

/// One file of a series.
struct PvdEntry {
  double time = 0.0;  ///< row of the history, or time
  std::string file;   ///< its name, in the folder of the .pvd file

  template <class Archive>
  void serialize(Archive& archive) {
    archive(time, file);
  }
};

/// \throws FileError
void write_pvd(const std::string& path, const std::vector<PvdEntry>& entries);
/// \throws FileError, also where a file of the series is in another folder
std::vector<PvdEntry> read_pvd(const std::string& path);

}  // namespace perilink
