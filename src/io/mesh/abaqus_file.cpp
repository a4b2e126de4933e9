#include "io/mesh/abaqus_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "base/plain_text.hpp"
#include "io/mesh/abaqus_lines.hpp"
#include "io/mesh/abaqus_sets.hpp"
#include "io/text/toml_tree.hpp"

namespace perilink {
namespace {

/// Begin of the names of element types. The digits behind it are the number of nodes.
struct Family {
  std::string_view name;
  int dim;
};
constexpr Family families[] = {{"CPS", 2}, {"CPE", 2}, {"C3D", 3},   {"S", 2},
                               {"M3D", 2}, {"R3D", 2}, {"SFM3D", 2}, {"T2D", 1},
                               {"T3D", 1}, {"R2D", 1}, {"B2", 1},    {"B3", 1}};

/// Element type with its number of nodes, the first of which are its corners.
struct AbaqusType {
  CellShape shape = CellShape::point;
  int nodes = 0;  ///< 0: not read
};

CellShape shape_of(int dim, int nodes) {
  using enum CellShape;
  if (dim == 1) return nodes == 2 || nodes == 3 ? line : point;
  if (dim == 2) {
    return nodes == 3 || nodes == 6 ? triangle : nodes == 4 || nodes >= 8 ? quadrilateral : point;
  }
  switch (nodes) {
    case 4:
    case 10: return tetrahedron;
    case 5: return pyramid;
    case 6:
    case 15: return wedge;
    case 8:
    case 20:
    case 27: return hexahedron;
    default: return point;
  }
}

/// Returns the kind of element of a name such as "CPS4R".
AbaqusType abaqus_type(std::string_view name) {
  for (const Family& family : families) {
    if (!name.starts_with(family.name)) continue;
    const std::string_view rest = name.substr(family.name.size());
    int nodes = 0;
    const auto parsed = std::from_chars(rest.data(), rest.data() + rest.size(), nodes);
    if (parsed.ec != std::errc()) continue;
    // The digit of a beam is the degree of its shape functions; degrees 1 and 3 have two nodes.
    if (family.name.starts_with('B')) nodes = nodes == 2 ? 3 : 2;
    const CellShape shape = shape_of(family.dim, nodes);
    if (shape != CellShape::point) return {shape, nodes};
  }
  return {};
}

/// Reads the keywords of an input file in turn.
class AbaqusReader {
 public:
  AbaqusReader(std::string_view bytes, const std::string& path)
      : lines_(bytes, path), sets_(listing_, path) {}

  MeshListing read(const std::string& path);

 private:
  enum class Place : std::uint8_t { model, part, assembly, instance };

  void read_keyword(const AbaqusKeyword& keyword);
  void enter(const AbaqusKeyword& keyword);
  void read_instance(const AbaqusKeyword& keyword);
  void read_nodes(const AbaqusKeyword& keyword);
  void read_elements(const AbaqusKeyword& keyword);
  void read_set(const AbaqusKeyword& keyword);
  void read_surface(const AbaqusKeyword& keyword);
  std::optional<std::int64_t> label_in_set(std::string_view entry) const;
  std::string set_name(std::string_view entry) const;
  void put_middles_between();
  void refuse_other_files(const AbaqusKeyword& keyword) const;
  /// Whether labels outside of sets belong to the assembly: reference points, not the mesh.
  bool outside_mesh(const AbaqusKeyword& keyword) const {
    return place_ == Place::assembly && !keyword.has("INSTANCE");
  }

  AbaqusLines lines_;
  MeshListing listing_;
  AbaqusSets sets_;
  Place place_ = Place::model;
  int part_ = 0, part_with_nodes_ = -1;  ///< parts and instances in the order of the file
  std::set<std::string> instanced_;      ///< parts that have an instance
  std::set<std::string> instances_;      ///< names of instances
  /// Place of each three-node line in MeshListing::corners, with the tag of its middle node.
  std::vector<std::pair<std::size_t, std::int64_t>> middles_;
  std::set<std::string> skipped_;  ///< keywords and element types
};

void AbaqusReader::refuse_other_files(const AbaqusKeyword& keyword) const {
  if (!keyword.has("INPUT")) return;
  lines_.refuse(
      fmt::format("reads the file {} by *{}", quoted(keyword.value("INPUT")), keyword.name),
      "insert the lines of that file here");
}

/// Enters or leaves a part, an instance or the assembly.
void AbaqusReader::enter(const AbaqusKeyword& keyword) {
  const bool leaves = keyword.name.starts_with("END");
  const bool is_assembly = keyword.name.ends_with("ASSEMBLY");
  if (keyword.name == "INSTANCE") return read_instance(keyword);
  if (keyword.name == "END INSTANCE") {
    place_ = Place::assembly;
  } else {
    place_ = leaves ? Place::model : is_assembly ? Place::assembly : Place::part;
  }
  if (keyword.name == "PART") ++part_;
}

void AbaqusReader::read_instance(const AbaqusKeyword& keyword) {
  place_ = Place::instance;
  ++part_;
  instances_.insert(upper(keyword.value("NAME")));
  if (!instanced_.insert(upper(keyword.value("PART"))).second) {
    lines_.refuse(
        fmt::format("has several instances of the part {}", quoted(keyword.value("PART"))),
        "merge the instances into one part: Merge/Cut Instances in Abaqus/CAE");
  }
  while (const auto data = lines_.next_data()) {
    if (std::ranges::all_of(*data, [&](auto entry) { return lines_.number(entry) == 0.0; })) {
      continue;
    }
    lines_.refuse("moves the instance of a part, which is not read",
                  "move the part itself, or write the file without parts and assemblies");
  }
}

void AbaqusReader::read_nodes(const AbaqusKeyword& keyword) {
  refuse_other_files(keyword);
  if (const std::string system = upper(keyword.value("SYSTEM")); !system.empty() && system != "R") {
    lines_.refuse("has nodes in cylindrical or spherical coordinates",
                  "write the nodes in Cartesian coordinates, without SYSTEM");
  }
  if (outside_mesh(keyword)) {
    skipped_.insert("*NODE of the assembly");
    return;
  }
  if (part_with_nodes_ >= 0 && part_with_nodes_ != part_) {
    lines_.refuse("has nodes in several parts",
                  "merge them into one part: Merge/Cut Instances in Abaqus/CAE");
  }
  part_with_nodes_ = part_;
  while (const auto data = lines_.next_data()) {
    const std::int64_t label = lines_.label(data->front());
    listing_.node_tags.push_back(label);
    for (std::size_t axis = 1; axis <= 3; ++axis) {
      listing_.coordinates.push_back(axis < data->size() ? lines_.number((*data)[axis]) : 0.0);
    }
    if (keyword.has("NSET")) sets_.add_node(keyword.value("NSET"), {label, label, 1});
  }
}

void AbaqusReader::read_elements(const AbaqusKeyword& keyword) {
  refuse_other_files(keyword);
  const std::string name = upper(keyword.value("TYPE"));
  if (name.starts_with("CAX") || name.starts_with("CGAX")) {
    lines_.refuse(fmt::format("has axisymmetric elements ({}), which no kind of body has", name),
                  "mesh the solid in space, or a plane section of it with CPS or CPE elements");
  }
  const AbaqusType type = abaqus_type(name);
  if (type.nodes == 0) {
    skipped_.insert("elements of type " + name);
    return;
  }
  if (name.starts_with("CP")) sets_.add_plane_solids();
  const ShapeProperties& properties = properties_of(type.shape);
  const auto width = static_cast<std::size_t>(type.nodes) + 1;
  while (auto data = lines_.next_data()) {
    while (data->size() < width) {
      const auto more = lines_.next_data();
      if (!more) break;
      data->insert(data->end(), more->begin(), more->end());
    }
    if (data->size() != width) {
      lines_.refuse(fmt::format("has an element of type {} with {} nodes instead of {}", name,
                                data->size() - 1, type.nodes),
                    "write the mesh again");
    }
    const std::int64_t label = lines_.label(data->front());
    listing_.shapes.push_back(type.shape);
    listing_.element_tags.push_back(label);
    const bool is_curved_line = type.shape == CellShape::line && type.nodes == 3;
    if (is_curved_line) middles_.emplace_back(listing_.corners.size(), lines_.label((*data)[2]));
    for (int k = 1; k <= properties.corners; ++k) {
      listing_.corners.push_back(lines_.label((*data)[is_curved_line ? 2 * k - 1 : k]));
    }
    if (type.nodes > properties.corners) listing_.second_order[properties.dim] = true;
    if (keyword.has("ELSET")) sets_.add_element(keyword.value("ELSET"), {label, label, 1});
  }
}

/// Makes the node between the two others the middle of every three-node line. Abaqus writes end,
/// middle, end; some programs write the middle last.
void AbaqusReader::put_middles_between() {
  if (middles_.empty()) return;
  std::map<std::int64_t, const double*> position;
  for (std::size_t i = 0; i < listing_.node_tags.size(); ++i) {
    position[listing_.node_tags[i]] = &listing_.coordinates[3 * i];
  }
  // Whether the directions from `between` to the two others make an obtuse angle.
  const auto lies_between = [&](std::int64_t between, std::int64_t a, std::int64_t b) {
    const double *x = position.at(between), *y = position.at(a), *z = position.at(b);
    return (y[0] - x[0]) * (z[0] - x[0]) + (y[1] - x[1]) * (z[1] - x[1]) +
               (y[2] - x[2]) * (z[2] - x[2]) <
           0.0;
  };
  for (const auto& [corner, middle] : middles_) {
    std::int64_t &first = listing_.corners[corner], &second = listing_.corners[corner + 1];
    const bool is_complete = position.count(first) > 0 && position.count(middle) > 0 &&
                             position.count(second) > 0;  // else refused with the mesh
    if (!is_complete) continue;
    if (lies_between(second, first, middle)) {
      second = middle;
    } else if (lies_between(first, middle, second)) {
      first = middle;
    }
  }
}

/// Returns the name of a set in a data line, without quotes and the name of the instance.
std::string AbaqusReader::set_name(std::string_view entry) const {
  std::string name(entry);
  std::erase(name, '"');
  const std::size_t dot = name.find('.');
  if (dot != name.npos && instances_.count(upper(name.substr(0, dot))) > 0) name.erase(0, dot + 1);
  return name;
}

/// Returns the label of "5" or "Part-1-1.5"; none for names.
std::optional<std::int64_t> AbaqusReader::label_in_set(std::string_view entry) const {
  const std::size_t dot = entry.rfind('.');
  const std::string_view label = dot == entry.npos ? entry : entry.substr(dot + 1);
  if (!AbaqusLines::is_label(label)) return std::nullopt;
  return lines_.label(label);
}

void AbaqusReader::read_set(const AbaqusKeyword& keyword) {
  refuse_other_files(keyword);
  const bool of_nodes = keyword.name == "NSET";
  const std::string name = keyword.value(keyword.name);
  if (name.empty()) lines_.refuse(fmt::format("has *{} without a name", keyword.name), "");
  const auto add = [&](const LabelRange& range) {
    of_nodes ? sets_.add_node(name, range) : sets_.add_element(name, range);
  };
  if (of_nodes && keyword.has("ELSET")) {
    sets_.add_nodes_of(name, set_name(keyword.value("ELSET")));
  }
  while (const auto data = lines_.next_data()) {
    if (keyword.has("GENERATE")) {
      if (data->size() < 2) lines_.refuse("has a range of labels without an end", "");
      const std::int64_t step = data->size() > 2 ? lines_.label((*data)[2]) : 1;
      const std::int64_t first = lines_.label((*data)[0]), last = lines_.label((*data)[1]);
      if (step > 0 && (last - first) % step != 0) {
        lines_.refuse(fmt::format("has a range from {} to {} in steps of {}, which miss its end",
                                  first, last, step),
                      "give the last label that belongs to the set");
      }
      if (!outside_mesh(keyword)) add({first, last, step});
      continue;
    }
    for (const std::string_view entry : *data) {
      if (entry.empty()) continue;
      const auto label = label_in_set(entry);
      const bool own = entry.find('.') != entry.npos || !outside_mesh(keyword);
      if (label && own) add({*label, *label, 1});
      if (!label) sets_.add_set(of_nodes, name, set_name(entry));
    }
  }
}

void AbaqusReader::read_surface(const AbaqusKeyword& keyword) {
  const std::string type = upper(keyword.value("TYPE"));
  const std::string name = keyword.value("NAME");
  if (type != "" && type != "ELEMENT" && type != "NODE") {
    skipped_.insert("*SURFACE of type " + type);
    return;
  }
  if (name.empty()) lines_.refuse("has *SURFACE without a name", "");
  const std::string combine = upper(keyword.value("COMBINE"));
  if (!combine.empty() && combine != "UNION") {
    lines_.refuse(fmt::format("has a surface by COMBINE={}", combine),
                  "only UNION is read; give the faces of the surface");
  }
  while (const auto data = lines_.next_data()) {
    if (!combine.empty()) {
      for (const std::string_view other : *data) sets_.add_surface(name, set_name(other));
      continue;
    }
    const std::string_view entry = data->front();
    const auto label = label_in_set(entry);
    const LabelRange range = label ? LabelRange{*label, *label, 1} : LabelRange{1, 0, 1};
    const std::string set = label ? std::string() : set_name(entry);
    if (type == "NODE") {
      if (label) sets_.add_node(name, range);
      if (!label) sets_.add_set(true, name, set);
    } else {
      sets_.add_faces({name, {range}, data->size() > 1 ? upper((*data)[1]) : "", lines_.line()},
                      set);
    }
  }
}

void AbaqusReader::read_keyword(const AbaqusKeyword& keyword) {
  using Reader = void (AbaqusReader::*)(const AbaqusKeyword&);
  static const std::map<std::string, Reader> readers = {
      {"PART", &AbaqusReader::enter},          {"END PART", &AbaqusReader::enter},
      {"ASSEMBLY", &AbaqusReader::enter},      {"END ASSEMBLY", &AbaqusReader::enter},
      {"INSTANCE", &AbaqusReader::enter},      {"END INSTANCE", &AbaqusReader::enter},
      {"NODE", &AbaqusReader::read_nodes},     {"ELEMENT", &AbaqusReader::read_elements},
      {"NSET", &AbaqusReader::read_set},       {"ELSET", &AbaqusReader::read_set},
      {"SURFACE", &AbaqusReader::read_surface}};
  static const std::set<std::string> generators = {"SYSTEM", "NGEN",  "NFILL",  "NCOPY",
                                                   "NMAP",   "ELGEN", "ELCOPY", "INCLUDE"};
  if (const auto found = readers.find(keyword.name); found != readers.end()) {
    return (this->*found->second)(keyword);
  }
  if (generators.count(keyword.name) > 0) {
    lines_.refuse(fmt::format("has *{}, which reads another file, or moves or generates nodes and "
                              "elements",
                              keyword.name),
                  "write a file with all nodes and elements: Create Input File in Abaqus/CAE");
  }
  if (keyword.name != "HEADING" && keyword.name != "PREPRINT") skipped_.insert("*" + keyword.name);
}

MeshListing AbaqusReader::read(const std::string& path) {
  while (const auto keyword = lines_.next_keyword()) {
    read_keyword(*keyword);
    if (keyword->name == "STEP") break;  // loads and results follow
  }
  if (!skipped_.empty()) {
    listing_.notes.push_back(
        fmt::format("{}: skipped {}: only nodes, elements, sets and surfaces are read", path,
                    joined(std::vector<std::string>(skipped_.begin(), skipped_.end()))));
  }
  put_middles_between();
  sets_.add_groups();
  return std::move(listing_);
}

}  // namespace

MeshListing read_abaqus(std::string_view bytes, const std::string& path) {
  return AbaqusReader(bytes, path).read(path);
}

}  // namespace perilink
