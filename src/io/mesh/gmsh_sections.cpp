#include "io/mesh/gmsh_sections.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <optional>
#include <set>

#include "io/mesh/gmsh_cursor.hpp"
#include "io/mesh/other_formats.hpp"
#include "io/text/toml_tree.hpp"

namespace perilink {
namespace {

/// Most groups of one entity. Every element is entered in each group, so a damaged file could
/// request any amount of memory.
constexpr std::size_t most_physical_groups = 1000;

/// \return whether the file has version 2
bool read_format(GmshCursor& file) {
  const std::string version(file.word());
  const bool old = version == "2.2" || version == "2.1";
  if (version != "4.1" && !old) {
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
  return old;
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

/// Reads the sections of version 4.1.
class Version4 {
 public:
  Version4(GmshCursor& file, GmshSections& sections) : file_(file), sections_(sections) {}

  void read_entities();
  void read_nodes();
  void read_elements();
  void add_groups();

 private:
  struct Block {
    GmshKey entity;
    Index first, last;  ///< range of elements
  };

  GmshKey read_entity_of_block();

  GmshCursor& file_;
  GmshSections& sections_;
  std::map<GmshKey, std::vector<int>> physical_tags_;  ///< by entity
  std::vector<Block> blocks_;
};

void Version4::read_entities() {
  std::size_t counts[4];
  for (std::size_t& count : counts) count = file_.count(1, "entities");
  for (int dim = 0; dim <= 3; ++dim) {
    for (std::size_t i = 0; i < counts[dim]; ++i) {
      const int tag = file_.integer();
      for (int k = 0; k < (dim == 0 ? 3 : 6); ++k) file_.number();  // position or bounding box
      std::vector<int> physical(file_.count(1, "physical groups"));
      if (physical.size() > most_physical_groups) {
        file_.refuse(fmt::format("has an entity in {} physical groups", physical.size()),
                     fmt::format("{} are possible", most_physical_groups));
      }
      // A negative tag reverses the elements of the group; their orientation is not used.
      for (int& group : physical) group = std::abs(std::max(file_.integer(), -INT32_MAX));
      for (auto k = dim > 0 ? file_.count(1, "bounding entities") : 0; k > 0; --k) file_.integer();
      physical_tags_[{dim, tag}] = std::move(physical);
    }
  }
  file_.expect_end_of("Entities");
}

GmshKey Version4::read_entity_of_block() {
  const int dim = file_.integer();
  const int tag = file_.integer();
  if (dim < 0 || dim > 3) file_.refuse(fmt::format("has an entity of dimension {}", dim));
  return {dim, tag};
}

void Version4::read_nodes() {
  MeshListing& listing = sections_.listing;
  const std::size_t num_blocks = file_.count(4, "blocks of nodes");
  for (int k = 0; k < 3; ++k) file_.size();  // number of nodes, smallest and largest tag
  for (std::size_t block = 0; block < num_blocks; ++block) {
    const int dim = read_entity_of_block().first;
    const bool parametric = file_.integer() != 0;
    const std::size_t count = file_.count(4, "nodes");
    for (std::size_t i = 0; i < count; ++i) listing.node_tags.push_back(file_.size());
    for (std::size_t i = 0; i < count; ++i) {
      for (int axis = 0; axis < 3; ++axis) listing.coordinates.push_back(file_.number());
      for (int k = 0; parametric && k < dim; ++k) file_.number();
    }
  }
  file_.expect_end_of("Nodes");
}

void Version4::read_elements() {
  MeshListing& listing = sections_.listing;
  const std::size_t num_blocks = file_.count(4, "blocks of elements");
  for (int k = 0; k < 3; ++k) file_.size();  // number of elements, smallest and largest tag
  for (std::size_t b = 0; b < num_blocks; ++b) {
    const GmshKey entity = read_entity_of_block();
    const GmshType type = gmsh_type(file_, file_.integer());
    const ShapeProperties& properties = properties_of(type.shape);
    if (properties.dim != entity.first) {
      file_.refuse(
          fmt::format("has {} on an entity of dimension {}", properties.plural, entity.first));
    }
    const std::size_t count = file_.count(static_cast<std::size_t>(type.nodes) + 1, "elements");
    const Index first = listing.num_elements();
    for (std::size_t i = 0; i < count; ++i) {
      const std::int64_t tag = file_.size();
      add_gmsh_element(
          type, tag, [&] { return file_.size(); }, listing);
    }
    blocks_.push_back({entity, first, listing.num_elements()});
  }
  file_.expect_end_of("Elements");
}

/// Adds the elements to their physical groups, after all sections have been read.
void Version4::add_groups() {
  for (const Block& block : blocks_) {
    const std::vector<int>& tags = physical_tags_[block.entity];
    for (const int tag : std::set<int>(tags.begin(), tags.end())) {
      std::vector<Index>& group = sections_.elements[{block.entity.first, tag}];
      for (Index e = block.first; e < block.last; ++e) group.push_back(e);
    }
  }
}

/// Names the physical groups, and merges those of equal dimension and name.
void add_named_groups(GmshSections& sections) {
  std::map<std::pair<int, std::string>, std::size_t> number;
  std::vector<MeshListing::Group>& groups = sections.listing.groups;
  for (auto& [key, elements] : sections.elements) {
    const auto found = sections.names.find(key);
    std::string name = found != sections.names.end() ? found->second : std::to_string(key.second);
    const auto [known, is_new] = number.try_emplace({key.first, name}, groups.size());
    if (is_new) {
      groups.push_back({std::move(name), key.first, std::move(elements)});
      continue;
    }
    std::vector<Index>& all = groups[known->second].elements;
    all.insert(all.end(), elements.begin(), elements.end());
    std::sort(all.begin(), all.end());
    all.erase(std::unique(all.begin(), all.end()), all.end());
  }
}

/// Returns the name of the section that begins here; none at the end of the file.
std::optional<std::string> section_name(GmshCursor& file, bool format_known) {
  if (file.at_end()) return std::nullopt;
  std::string_view header = file.line();
  while (!header.empty() && (header.back() == ' ' || header.back() == '\t')) {
    header.remove_suffix(1);
  }
  if (!format_known && header != "$MeshFormat" && header != "$Comments") {
    file.refuse("does not begin with $MeshFormat, so it is no mesh of gmsh",
                conversion_of_others(file.path()));
  }
  if (!header.starts_with('$')) {
    file.refuse(
        fmt::format("has {} where a section $... should begin", quoted(std::string(header))));
  }
  return std::string(header.substr(1));
}

}  // namespace

GmshType gmsh_type(const GmshCursor& file, int number) {
  using enum CellShape;
  static const std::map<int, GmshType> types = {
      {15, {point, 1}},          {1, {line, 2}},           {8, {line, 3}},
      {26, {line, 4}},           {27, {line, 5}},          {28, {line, 6}},
      {2, {triangle, 3}},        {9, {triangle, 6}},       {20, {triangle, 9}},
      {21, {triangle, 10}},      {22, {triangle, 12}},     {23, {triangle, 15}},
      {3, {quadrilateral, 4}},   {10, {quadrilateral, 9}}, {16, {quadrilateral, 8}},
      {36, {quadrilateral, 16}}, {4, {tetrahedron, 4}},    {11, {tetrahedron, 10}},
      {29, {tetrahedron, 20}},   {30, {tetrahedron, 35}},  {5, {hexahedron, 8}},
      {12, {hexahedron, 27}},    {17, {hexahedron, 20}},   {92, {hexahedron, 64}},
      {6, {wedge, 6}},           {13, {wedge, 18}},        {18, {wedge, 15}},
      {7, {pyramid, 5}},         {14, {pyramid, 14}},      {19, {pyramid, 13}}};
  const auto found = types.find(number);
  if (found != types.end()) return found->second;
  file.refuse(fmt::format("has elements of gmsh's type {}", number),
              "triangles and quadrilaterals in the plane, and tetrahedra, hexahedra, wedges and "
              "pyramids in space are read: save the mesh without this element");
}

MeshListing read_gmsh(std::string_view bytes, const std::string& path) {
  if (bytes.starts_with("\xEF\xBB\xBF")) bytes.remove_prefix(3);  // byte order mark of UTF-8
  GmshCursor file(bytes, path);
  GmshSections sections;
  Version4 version_4(file, sections);
  bool format_known = false, is_old = false;
  while (const auto section = section_name(file, format_known)) {
    const std::string& name = *section;
    if (name == "MeshFormat") {
      is_old = read_format(file);
      format_known = true;
    } else if (name == "PhysicalNames") {
      read_names(file, sections);
    } else if (name == "Entities" && !is_old) {
      version_4.read_entities();
    } else if (name == "Nodes") {
      is_old ? read_nodes_2(file, sections) : version_4.read_nodes();
    } else if (name == "Elements") {
      is_old ? read_elements_2(file, sections) : version_4.read_elements();
    } else if (name == "PartitionedEntities") {
      file.refuse("is partitioned", "save the mesh before it is partitioned");
    } else {
      file.skip_to_end_of(name);
    }
  }
  if (!format_known) file.refuse("is empty", "write the mesh again");
  version_4.add_groups();
  add_named_groups(sections);
  return std::move(sections.listing);
}

}  // namespace perilink
