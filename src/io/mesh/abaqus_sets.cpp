#include "io/mesh/abaqus_sets.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "base/error.hpp"
#include "base/plain_text.hpp"
#include "io/mesh/abaqus_lines.hpp"
#include "io/text/toml_tree.hpp"

namespace perilink {
namespace {

/// Most memberships in sets for each node and element. A damaged file could request any amount of
/// memory.
constexpr std::size_t most_memberships = 1000;

using Labels = std::vector<std::pair<std::int64_t, Index>>;

Labels sorted_labels(const std::vector<std::int64_t>& tags) {
  Labels labels;
  for (std::size_t i = 0; i < tags.size(); ++i) labels.emplace_back(tags[i], i);
  std::ranges::sort(labels);
  return labels;
}

}  // namespace

AbaqusSets::Set& AbaqusSets::find(std::map<std::string, Set>& sets, const std::string& name) {
  return sets.try_emplace(upper(name), Set{name, {}}).first->second;
}

void AbaqusSets::add_node(const std::string& set, const LabelRange& range) {
  find(node_sets_, set).labels.push_back(range);
}

void AbaqusSets::add_element(const std::string& set, const LabelRange& range) {
  find(element_sets_, set).labels.push_back(range);
}

void AbaqusSets::add_set(bool of_nodes, const std::string& set, const std::string& other) {
  std::map<std::string, Set>& sets = of_nodes ? node_sets_ : element_sets_;
  std::vector<LabelRange>& labels = find(sets, set).labels;
  const auto found = sets.find(upper(other));
  if (found == sets.end()) {
    incomplete_.insert(set);
  } else if (&found->second.labels != &labels) {
    labels.insert(labels.end(), found->second.labels.begin(), found->second.labels.end());
    if (!of_nodes) return;
    const std::vector<std::string>& more = corners_of_[upper(other)];
    std::vector<std::string>& corners = corners_of_[upper(set)];
    corners.insert(corners.end(), more.begin(), more.end());
  }
}

void AbaqusSets::add_nodes_of(const std::string& set, const std::string& elements) {
  find(node_sets_, set);
  corners_of_[upper(set)].push_back(elements);
}

void AbaqusSets::add_faces(AbaqusFaces faces, const std::string& set) {
  const auto found = element_sets_.find(upper(set));
  if (!set.empty() && found == element_sets_.end()) {
    incomplete_.insert(faces.surface);
    return;
  }
  if (!set.empty()) faces.elements = found->second.labels;
  faces_.push_back(std::move(faces));
}

void AbaqusSets::add_surface(const std::string& surface, const std::string& other) {
  const std::size_t before = faces_.size();
  for (std::size_t k = 0; k < before; ++k) {
    if (upper(faces_[k].surface) != upper(other)) continue;
    AbaqusFaces copy = faces_[k];
    copy.surface = surface;
    faces_.push_back(std::move(copy));
  }
  if (faces_.size() == before) add_set(true, surface, other);
}

std::vector<Index> AbaqusSets::members(const Labels& all, const std::string& set,
                                       std::span<const LabelRange> ranges) {
  std::vector<Index> found;
  for (const LabelRange& range : ranges) {
    const std::size_t before = found.size();
    auto place = std::ranges::lower_bound(all, std::pair(range.first, Index{0}));
    for (; place != all.end() && place->first <= range.last; ++place) {
      if ((place->first - range.first) % range.step == 0) found.push_back(place->second);
    }
    if (found.size() == before) incomplete_.insert(set);
    if (found.size() > members_left_) {
      throw InputError({path_, 0, ""}, fmt::format("has too many members of {}", quoted(set)),
                       "write the mesh again");
    }
  }
  members_left_ -= found.size();
  std::ranges::sort(found);
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

MeshListing::Group& AbaqusSets::group(int dim, const std::string& name) {
  return groups_.try_emplace({dim, upper(name)}, MeshListing::Group{name, dim, {}}).first->second;
}

/// Adds an element to the listing and to a group.
void AbaqusSets::add(const std::string& name, CellShape shape,
                     std::span<const std::int64_t> corners) {
  group(properties_of(shape).dim, name).elements.push_back(listing_.num_elements());
  listing_.shapes.push_back(shape);
  listing_.element_tags.push_back(0);
  listing_.corners.insert(listing_.corners.end(), corners.begin(), corners.end());
}

/// Refuses names of sides that elements of a dimension do not have.
void AbaqusSets::check_side(const AbaqusFaces& faces, int dim) const {
  const std::string& side = faces.side;
  const bool is_solid = dim == 3 || (dim == 2 && plane_solids_);
  const bool is_numbered = side.size() == 2 && side[1] >= '1' && side[1] <= '9';
  if (side.empty() || (is_numbered && side[0] == 'S')) return;
  if (!is_solid && (side == "SPOS" || side == "SNEG" || (is_numbered && side[0] == 'E'))) return;
  throw InputError({path_, faces.line, ""},
                   fmt::format("has the surface {} with {}, which is no face of its elements",
                               quoted(faces.surface), quoted(side)),
                   "solid elements have the faces S1, S2, ...; shells have SPOS, SNEG and the "
                   "edges E1, E2, ...");
}

void AbaqusSets::add_sides(const AbaqusFaces& faces, std::span<const std::size_t> begin) {
  const bool is_shell_face = faces.side == "SPOS" || faces.side == "SNEG";
  const int wanted = faces.side.empty() || is_shell_face ? 0 : faces.side.back() - '0';
  for (const Index e : members(elements_, faces.surface, faces.elements)) {
    const ShapeProperties& properties = properties_of(listing_.shapes[e]);
    check_side(faces, properties.dim);
    if (is_shell_face) {
      group(properties.dim, faces.surface).elements.push_back(e);
      continue;
    }
    if (wanted > static_cast<int>(properties.sides.size())) {
      incomplete_.insert(faces.surface);
      continue;
    }
    for (int side = 0; side < static_cast<int>(properties.sides.size()); ++side) {
      if (wanted > 0 && side != wanted - 1) continue;
      const ShapeSide& own = properties.sides[side];
      std::vector<std::int64_t> corners;
      for (int k = 0; k < own.count; ++k) {
        corners.push_back(listing_.corners[begin[e] + own.corners[k]]);
      }
      add(faces.surface, shape_of_side(own.count), corners);
    }
  }
}

void AbaqusSets::add_groups() {
  const Labels nodes = sorted_labels(listing_.node_tags);
  elements_ = sorted_labels(listing_.element_tags);
  for (std::size_t i = 1; i < elements_.size(); ++i) {
    if (elements_[i].first != elements_[i - 1].first) continue;
    throw InputError({path_, 0, ""},
                     fmt::format("has two elements with the label {}", elements_[i].first), "");
  }
  members_left_ = most_memberships * (nodes.size() + elements_.size());
  std::vector<std::size_t> begin(1, 0);
  for (const CellShape shape : listing_.shapes) {
    begin.push_back(begin.back() + properties_of(shape).corners);
  }
  std::map<std::string, std::vector<Index>> members_of;
  for (const auto& [key, set] : element_sets_) {
    members_of[key] = members(elements_, set.name, set.labels);
    for (const Index e : members_of[key]) {
      group(properties_of(listing_.shapes[e]).dim, set.name).elements.push_back(e);
    }
  }
  for (const AbaqusFaces& faces : faces_) add_sides(faces, begin);
  for (const auto& [key, set] : node_sets_) {
    for (const std::string& other : corners_of_[key]) {
      for (const Index e : members_of[upper(other)]) {
        for (std::size_t k = begin[e]; k < begin[e + 1]; ++k) {
          const std::int64_t corner = listing_.corners[k];
          add(set.name, CellShape::point, std::span(&corner, 1));
        }
      }
    }
    for (const Index i : members(nodes, set.name, set.labels)) {
      add(set.name, CellShape::point, std::span(&listing_.node_tags[i], 1));
    }
  }
  for (auto& [key, group] : groups_) {
    std::ranges::sort(group.elements);
    group.elements.erase(std::unique(group.elements.begin(), group.elements.end()),
                         group.elements.end());
    listing_.groups.push_back(std::move(group));
  }
  if (incomplete_.empty()) return;
  listing_.notes.push_back(fmt::format(
      "{}: not all members of these sets and surfaces are among the nodes and elements that are "
      "read: {}",
      path_, joined(std::vector<std::string>(incomplete_.begin(), incomplete_.end()))));
}

}  // namespace perilink
