#include "io/mesh/gmsh_sections.hpp"

#include <fmt/format.h>

#include <cstdlib>

#include "io/mesh/gmsh_cursor.hpp"
#include "io/mesh/other_formats.hpp"
#include "io/text/toml_tree.hpp"

namespace perilink {
namespace {

/// Most groups of one entity. Every element is entered in each group, so a damaged file could
/// request any amount of memory.
constexpr std::size_t most_physical_groups = 1000;

void read_format(GmshCursor& file) {
  const std::string version(file.word());
  if (version != "4.1") {
    file.refuse(fmt::format("is in version {} of gmsh's format", quoted(version)),
                conversion_to_41(file.path()));
  }
  const std::int64_t kind = file.text_integer();
  if (kind != 0 && kind != 1) file.refuse("is neither text nor binary", "write the mesh again");
  if (const std::int64_t bytes = file.text_integer(); bytes != 8) {
    file.refuse(fmt::format("has numbers of {} bytes", bytes), "numbers of 8 bytes are read");
  }
  if (kind == 1) {
    file.line();
    file.set_binary(true);
    if (file.integer() != 1) {
      file.refuse("was written on a machine with another order of bytes",
                  "save the mesh as text: Mesh.Binary = 0");
    }
  }
  file.expect_end_of("MeshFormat");
}

/// Names are in quotes, one per line, as text also in binary files.
void read_names(GmshCursor& file, GmshSections& sections) {
  const std::int64_t count = file.text_integer();
  for (std::int64_t i = 0; i < count; ++i) {
    const std::int64_t dim = file.text_integer();
    const std::int64_t tag = file.text_integer();
    if (dim < 0 || dim > 3 || tag < 1 || tag > INT32_MAX) {
      file.refuse("has a physical group of an impossible dimension or tag");
    }
    const std::string_view rest = file.line();
    const std::size_t begin = rest.find('"'), end = rest.rfind('"');
    if (begin == end) file.refuse("has a physical group whose name is not between quotes");
    const std::string name(rest.substr(begin + 1, end - begin - 1));
    sections.names[{static_cast<int>(dim), static_cast<int>(tag)}] = name;
  }
  file.expect_end_of("PhysicalNames");
}

void read_entities(GmshCursor& file, GmshSections& sections) {
  std::size_t counts[4];
  for (std::size_t& count : counts) count = file.count(1, "entities");
  for (int dim = 0; dim <= 3; ++dim) {
    for (std::size_t i = 0; i < counts[dim]; ++i) {
      const int tag = file.integer();
      for (int k = 0; k < (dim == 0 ? 3 : 6); ++k) file.number();  // position or bounding box
      std::vector<int> physical(file.count(1, "physical groups"));
      if (physical.size() > most_physical_groups) {
        file.refuse(fmt::format("has an entity in {} physical groups", physical.size()),
                    fmt::format("{} are possible", most_physical_groups));
      }
      // A negative tag reverses the elements of the group; their orientation is not used.
      for (int& group : physical) group = std::abs(std::max(file.integer(), -INT32_MAX));
      for (auto k = dim > 0 ? file.count(1, "bounding entities") : 0; k > 0; --k) file.integer();
      sections.physical_tags[{dim, tag}] = std::move(physical);
    }
  }
  file.expect_end_of("Entities");
}

GmshKey read_entity_of_block(GmshCursor& file) {
  const int dim = file.integer();
  const int tag = file.integer();
  if (dim < 0 || dim > 3) file.refuse(fmt::format("has an entity of dimension {}", dim));
  return {dim, tag};
}

void read_nodes(GmshCursor& file, GmshSections& sections) {
  const std::size_t num_blocks = file.count(4, "blocks of nodes");
  for (int k = 0; k < 3; ++k) file.size();  // number of nodes, smallest and largest tag
  for (std::size_t block = 0; block < num_blocks; ++block) {
    const int dim = read_entity_of_block(file).first;
    const bool parametric = file.integer() != 0;
    const std::size_t count = file.count(4, "nodes");
    for (std::size_t i = 0; i < count; ++i) sections.node_tags.push_back(file.size());
    for (std::size_t i = 0; i < count; ++i) {
      for (int axis = 0; axis < 3; ++axis) sections.coordinates.push_back(file.number());
      for (int k = 0; parametric && k < dim; ++k) file.number();
    }
  }
  file.expect_end_of("Nodes");
}

int nodes_of_type(const GmshCursor& file, int type) {
  switch (type) {
    case 15: return 1;
    case 1: return 2;
    case 2: return 3;
    case 4: return 4;
    case 3:
      file.refuse("has quadrilaterals",
                  "mesh with triangles: leave out Recombine Surface and "
                  "Mesh.RecombineAll");
    case 5:
    case 6:
    case 7:
      file.refuse("has hexahedra, prisms or pyramids",
                  "mesh with tetrahedra: leave out Recombine, also in Extrude");
    case 8:
    case 9:
    case 10:
    case 11: file.refuse("has elements of second order", conversion_to_first_order(file.path()));
    default:
      file.refuse(fmt::format("has elements of gmsh's type {}", type),
                  "triangles in the plane and tetrahedra in space, both of first order, are read");
  }
}

void read_elements(GmshCursor& file, GmshSections& sections) {
  const std::size_t num_blocks = file.count(4, "blocks of elements");
  for (int k = 0; k < 3; ++k) file.size();  // number of elements, smallest and largest tag
  for (std::size_t b = 0; b < num_blocks; ++b) {
    GmshBlock block;
    block.entity = read_entity_of_block(file);
    block.type = file.integer();
    const int width = nodes_of_type(file, block.type);
    if (width != block.entity.first + 1) {
      file.refuse(fmt::format("has elements of {} corners on an entity of dimension {}", width,
                              block.entity.first));
    }
    const std::size_t count = file.count(static_cast<std::size_t>(width) + 1, "elements");
    block.nodes.reserve(count * width);
    for (std::size_t i = 0; i < count; ++i) {
      block.tags.push_back(file.size());
      for (int k = 0; k < width; ++k) block.nodes.push_back(file.size());
    }
    sections.blocks.push_back(std::move(block));
  }
  file.expect_end_of("Elements");
}

void read_section(GmshCursor& file, const std::string& name, GmshSections& sections) {
  if (name == "PhysicalNames") return read_names(file, sections);
  if (name == "Entities") return read_entities(file, sections);
  if (name == "Nodes") return read_nodes(file, sections);
  if (name == "Elements") return read_elements(file, sections);
  if (name == "PartitionedEntities") {
    file.refuse("is partitioned", "save the mesh before it is partitioned");
  }
  file.skip_to_end_of(name);
}

}  // namespace

GmshSections read_gmsh_sections(std::string_view bytes, const std::string& path) {
  if (bytes.starts_with("\xEF\xBB\xBF")) bytes.remove_prefix(3);  // byte order mark of UTF-8
  GmshCursor file(bytes, path);
  GmshSections sections;
  bool format_known = false;
  while (!file.at_end()) {
    std::string_view header = file.line();
    while (!header.empty() && (header.back() == ' ' || header.back() == '\t')) {
      header.remove_suffix(1);
    }
    if (!format_known && header != "$MeshFormat" && header != "$Comments") {
      file.refuse("does not begin with $MeshFormat, so it is no mesh of gmsh",
                  conversion_of_others(path));
    }
    if (!header.starts_with('$')) {
      file.refuse(
          fmt::format("has {} where a section $... should begin", quoted(std::string(header))));
    }
    const std::string name(header.substr(1));
    if (name == "MeshFormat") {
      read_format(file);
      format_known = true;
    } else if (name == "Comments") {
      file.skip_to_end_of(name);
    } else {
      read_section(file, name, sections);
    }
  }
  if (!format_known) file.refuse("is empty", "write the mesh again");
  if (sections.node_tags.empty() || sections.blocks.empty()) {
    file.refuse("holds no mesh: it has no nodes or no elements",
                "mesh the geometry before saving it: gmsh FILE.geo -2 (or -3)");
  }
  return sections;
}

}  // namespace perilink
