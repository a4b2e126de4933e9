#include "io/fields/vtu.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <pugixml.hpp>
#include <span>
#include <sstream>
#include <stdexcept>

#include "base/error.hpp"
#include "base/files.hpp"
#include "io/fields/vtk_encoding.hpp"

namespace perilink {
namespace {

static_assert(std::endian::native == std::endian::little, "the files say byte_order LittleEndian");

const VtuArray* find(const std::vector<VtuArray>& arrays, const std::string& name) {
  const auto found = std::find_if(arrays.begin(), arrays.end(),
                                  [&](const VtuArray& array) { return array.name == name; });
  return found == arrays.end() ? nullptr : &*found;
}

// ---------------------------------------------------------------------------------- checks

void check_arrays(const std::string& path, const std::vector<VtuArray>& arrays, std::size_t rows) {
  for (const VtuArray& array : arrays) {
    if (array.components < 1 ||
        array.values.size() != rows * static_cast<std::size_t>(array.components)) {
      throw FileError(path + ": array '" + array.name + "' has " +
                      std::to_string(array.values.size()) + " values, but " + std::to_string(rows) +
                      " rows of " + std::to_string(array.components));
    }
  }
}

/// Refuses grids that would make ParaView crash.
void check_grid(const std::string& path, const VtuGrid& grid) {
  if (grid.points.size() % 3 != 0) throw FileError(path + ": points are not triples");
  const std::size_t num_points = grid.points.size() / 3;
  if (grid.offsets.size() != grid.types.size()) {
    throw FileError(path + ": " + std::to_string(grid.offsets.size()) + " cell offsets for " +
                    std::to_string(grid.types.size()) + " cells");
  }
  std::int32_t end = 0;
  for (const std::int32_t offset : grid.offsets) {
    if (offset < end) throw FileError(path + ": cell offsets decrease");
    end = offset;
  }
  if (static_cast<std::size_t>(end) != grid.connectivity.size()) {
    throw FileError(path + ": the last cell does not end where the connectivity ends");
  }
  for (const std::int32_t point : grid.connectivity) {
    if (point < 0 || static_cast<std::size_t>(point) >= num_points) {
      throw FileError(path + ": a cell names point " + std::to_string(point) + " of " +
                      std::to_string(num_points));
    }
  }
  check_arrays(path, grid.point_data, num_points);
  check_arrays(path, grid.cell_data, grid.types.size());
}

// ---------------------------------------------------------------------------------- writing

template <class T>
pugi::xml_node append_array(pugi::xml_node parent, const char* type, const std::string& name,
                            int components, std::span<const T> values) {
  pugi::xml_node node = parent.append_child("DataArray");
  node.append_attribute("type") = type;
  node.append_attribute("Name") = name.c_str();
  node.append_attribute("NumberOfComponents") = components;
  node.append_attribute("format") = "binary";
  node.text().set(encode_array(std::as_bytes(values)).c_str());
  return node;
}

void append_arrays(pugi::xml_node parent, const std::vector<VtuArray>& arrays) {
  for (const VtuArray& array : arrays) {
    append_array<double>(parent, "Float64", array.name, array.components, array.values);
  }
}

pugi::xml_node append_file_node(pugi::xml_document& document, const char* type) {
  pugi::xml_node declaration = document.append_child(pugi::node_declaration);
  declaration.append_attribute("version") = "1.0";
  pugi::xml_node file = document.append_child("VTKFile");
  file.append_attribute("type") = type;
  file.append_attribute("version") = "1.0";
  file.append_attribute("byte_order") = "LittleEndian";
  file.append_attribute("header_type") = "UInt64";
  return file;
}

void save(const std::string& path, const pugi::xml_document& document) {
  std::ostringstream text;
  document.save(text, " ");
  write_whole_file(path, text.view());
}

// ---------------------------------------------------------------------------------- reading

/// Reads a file, and names it in every message.
class VtuReader {
 public:
  VtuReader(const std::string& path, const char* type) : path_(path) {
    const std::string text = read_regular_file(path);
    const pugi::xml_parse_result result = document_.load_buffer(text.data(), text.size());
    if (!result) fail(std::string("is not XML: ") + result.description());
    file_ = document_.child("VTKFile");
    if (file_.attribute("type").as_string() != std::string(type)) {
      fail(std::string("is not a VTK file of type ") + type);
    }
  }

  [[noreturn]] void fail(const std::string& fault) const { throw FileError(path_ + ": " + fault); }

  pugi::xml_node file() const { return file_; }

  /// Returns the path of the file in the same folder that an attribute names.
  std::string neighbour(pugi::xml_node node, const char* attribute) const {
    const std::string file = node.attribute(attribute).as_string();
    if (file.empty() || file == "." || file == ".." || file.find('/') != std::string::npos) {
      fail("names the file '" + file + "'; only files of the same folder are read");
    }
    return file;
  }

  template <class T>
  std::vector<T> values(pugi::xml_node array, const char* type) const {
    const std::string name = array.attribute("Name").as_string();
    if (array.attribute("type").as_string() != std::string(type) ||
        array.attribute("format").as_string() != std::string("binary")) {
      fail("array '" + name + "' is not binary " + type);
    }
    try {
      const std::vector<std::byte> bytes = decode_array(array.text().get());
      if (bytes.size() % sizeof(T) != 0) throw std::invalid_argument("its length is wrong");
      std::vector<T> result(bytes.size() / sizeof(T));
      if (!bytes.empty()) std::memcpy(result.data(), bytes.data(), bytes.size());
      return result;
    } catch (const std::invalid_argument& fault) {
      fail("array '" + name + "': " + fault.what());
    }
  }

  std::vector<VtuArray> arrays(pugi::xml_node parent) const {
    std::vector<VtuArray> result;
    for (pugi::xml_node node : parent.children("DataArray")) {
      result.push_back({node.attribute("Name").as_string(),
                        node.attribute("NumberOfComponents").as_int(1), numbers(node)});
    }
    return result;
  }

  std::vector<double> numbers(pugi::xml_node array) const {
    std::vector<double> result = values<double>(array, "Float64");
    // Squares of larger numbers leave the range of double precision.
    const auto usable = [](double value) { return std::abs(value) <= 1e150; };
    if (!std::all_of(result.begin(), result.end(), usable)) {
      fail(std::string("array '") + array.attribute("Name").as_string() +
           "' holds numbers that are not finite, or too large for any run");
    }
    return result;
  }

 private:
  std::string path_;
  pugi::xml_document document_;
  pugi::xml_node file_;
};

void read_cells(const VtuReader& reader, pugi::xml_node cells, VtuGrid& grid) {
  const auto array = [&](const char* name) {
    return cells.find_child_by_attribute("DataArray", "Name", name);
  };
  grid.connectivity = reader.values<std::int32_t>(array("connectivity"), "Int32");
  grid.offsets = reader.values<std::int32_t>(array("offsets"), "Int32");
  for (const std::uint8_t type : reader.values<std::uint8_t>(array("types"), "UInt8")) {
    const auto cell = static_cast<VtuCell>(type);
    if (cell != VtuCell::vertex && cell != VtuCell::line && cell != VtuCell::triangle &&
        cell != VtuCell::quadrilateral && cell != VtuCell::tetrahedron &&
        cell != VtuCell::hexahedron) {
      reader.fail("holds cells of VTK type " + std::to_string(type) +
                  "; only 1, 3, 5, 9, 10 and 12 are known");
    }
    grid.types.push_back(cell);
  }
}

}  // namespace

const VtuArray* VtuGrid::find_point_data(const std::string& name) const {
  return find(point_data, name);
}

const VtuArray* VtuGrid::find_cell_data(const std::string& name) const {
  return find(cell_data, name);
}

double VtuGrid::field(const std::string& name, double otherwise) const {
  for (const auto& [key, value] : field_data) {
    if (key == name) return value;
  }
  return otherwise;
}

void write_vtu(const std::string& path, const VtuGrid& grid) {
  check_grid(path, grid);
  pugi::xml_document document;
  pugi::xml_node file = append_file_node(document, "UnstructuredGrid");
  file.append_attribute("compressor") = "vtkZLibDataCompressor";
  pugi::xml_node body = file.append_child("UnstructuredGrid");

  pugi::xml_node fields = body.append_child("FieldData");
  for (const auto& [name, value] : grid.field_data) {
    append_array<double>(fields, "Float64", name, 1, std::span(&value, 1))
        .append_attribute("NumberOfTuples") = 1;
  }
  pugi::xml_node piece = body.append_child("Piece");
  piece.append_attribute("NumberOfPoints") = grid.points.size() / 3;
  piece.append_attribute("NumberOfCells") = grid.types.size();
  append_arrays(piece.append_child("PointData"), grid.point_data);
  append_arrays(piece.append_child("CellData"), grid.cell_data);
  append_array<double>(piece.append_child("Points"), "Float64", "Points", 3, grid.points);
  pugi::xml_node cells = piece.append_child("Cells");
  append_array<std::int32_t>(cells, "Int32", "connectivity", 1, grid.connectivity);
  append_array<std::int32_t>(cells, "Int32", "offsets", 1, grid.offsets);
  append_array<VtuCell>(cells, "UInt8", "types", 1, grid.types);
  save(path, document);
}

VtuGrid read_vtu(const std::string& path) {
  const VtuReader reader(path, "UnstructuredGrid");
  if (reader.file().attribute("compressor").as_string() != std::string("vtkZLibDataCompressor") ||
      reader.file().attribute("header_type").as_string() != std::string("UInt64")) {
    reader.fail("is not compressed by zlib with 64-bit headers, as this program writes");
  }
  const pugi::xml_node body = reader.file().child("UnstructuredGrid");
  const pugi::xml_node piece = body.child("Piece");
  VtuGrid grid;
  for (const VtuArray& field : reader.arrays(body.child("FieldData"))) {
    if (field.values.size() == 1) grid.field_data.emplace_back(field.name, field.values.front());
  }
  grid.points = reader.numbers(piece.child("Points").child("DataArray"));
  read_cells(reader, piece.child("Cells"), grid);
  grid.point_data = reader.arrays(piece.child("PointData"));
  grid.cell_data = reader.arrays(piece.child("CellData"));
  check_grid(path, grid);
  return grid;
}

void write_pvd(const std::string& path, const std::vector<PvdEntry>& entries) {
  pugi::xml_document document;
  pugi::xml_node collection = append_file_node(document, "Collection").append_child("Collection");
  for (const PvdEntry& entry : entries) {
    pugi::xml_node node = collection.append_child("DataSet");
    node.append_attribute("timestep") = fmt::format("{}", entry.time).c_str();
    node.append_attribute("part") = 0;
    node.append_attribute("file") = entry.file.c_str();
  }
  save(path, document);
}

std::vector<PvdEntry> read_pvd(const std::string& path) {
  const VtuReader reader(path, "Collection");
  std::vector<PvdEntry> entries;
  for (pugi::xml_node node : reader.file().child("Collection").children("DataSet")) {
    entries.push_back({node.attribute("timestep").as_double(), reader.neighbour(node, "file")});
  }
  return entries;
}

}  // namespace perilink
