#include "model/body/groups/drawn_groups.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "base/error.hpp"
#include "base/plain_text.hpp"
#include "discretization/facet_geometry.hpp"
#include "discretization/mesh_faces.hpp"
#include "discretization/meshes/mesh_curves.hpp"
#include "discretization/meshes/mesh_surfaces.hpp"
#include "io/case/case_schema.hpp"
#include "io/case/sections/case_kinds.hpp"
#include "io/text/toml_tree.hpp"

namespace perilink {
namespace {

/// Returns a group of a body whose `list` has members.
/// \param kind  "Curve" or "Surface", for messages
const Group& find_drawn(const CaseFile& input, const std::string& key, const std::string& name,
                        const Body& body, std::vector<Index> Group::*list, const char* kind) {
  std::vector<std::string_view> names;
  for (const Group& group : body.groups) {
    if ((group.*list).empty()) continue;
    if (group.name == name) return group;
    names.push_back(group.name);
  }
  throw InputError(
      input.where(key),
      fmt::format("is {}, but no Physical {} of this name lies in the body", quoted(name), kind),
      names.empty()
          ? fmt::format("write Physical {}({}) = {{...}}; in the geometry", kind, quoted(name))
          : suggest(name, names));
}

using Corners = std::vector<Index>;

std::map<Corners, Index> facets_by_corners(const Body& body) {
  std::map<Corners, Index> facets;
  for (Index f = 0; f < body.facets.size(); ++f) {
    const auto row = body.facets.corners.row(f);
    Corners corners(row.begin(), row.end());
    std::sort(corners.begin(), corners.end());
    facets.emplace(std::move(corners), f);
  }
  return facets;
}

/// Returns the area vector of a facet. It points to the left of a line, or to the side from which a
/// triangle runs counter-clockwise.
Vector3 normal_of(const Body& body, const Corners& corners) {
  const auto at = [&](std::size_t k) {
    return point_of(body.particles.positions, body.particles.dim, corners[k]);
  };
  const Vector3 along = minus(at(1), at(0));
  if (corners.size() == 2) return {-along[1], along[0], 0.0};
  return cross(along, minus(at(2), at(0)));
}

std::vector<Crack> faces_of_group(const Body& body, const Group& group) {
  const auto dim = static_cast<std::size_t>(body.particles.dim);
  const std::map<Corners, Index> facets = facets_by_corners(body);
  std::vector<Index> known, others;
  for (std::size_t s = 0; s < group.sides.size(); s += dim) {
    Corners corners(group.sides.begin() + s, group.sides.begin() + s + dim), sorted = corners;
    std::sort(sorted.begin(), sorted.end());
    const auto facet = facets.find(sorted);
    if (facet != facets.end()) {
      const double towards =
          dot(normal_of(body, corners),
              point_of(body.facets.area_vectors, body.particles.dim, facet->second));
      const bool wrong = body.facets.on_surface(facet->second) ? towards > 0.0 : towards < 0.0;
      if (wrong) std::swap(corners[dim - 2], corners[dim - 1]);
    }
    std::vector<Index>& list = facet != facets.end() ? known : others;
    list.insert(list.end(), corners.begin(), corners.end());
  }
  known.insert(known.end(), others.begin(), others.end());
  turn_alike(known, body.particles.dim);
  std::vector<Crack> faces;
  for (std::size_t c = 0; c < known.size(); ++c) {
    if (c % dim == 0) faces.emplace_back();
    faces.back().points.push_back(point_of(body.particles.positions, body.particles.dim, known[c]));
  }
  return faces;
}

}  // namespace

void refuse_loose_group(const CaseFile& input, const std::string& key, const Body& body,
                        const Group& group) {
  if (!group.loose) return;
  throw InputError(
      input.where(key),
      fmt::format("is {}, a {} of which, at ({}), is not {} of a cell", quoted(group.name),
                  group.lines.empty() ? "triangle" : "line",
                  joined({group.loose->data(), static_cast<std::size_t>(body.particles.dim)}),
                  group.lines.empty() ? "a side" : "an edge"),
      "embed it in the body before meshing (BooleanFragments or Coherence in "
      "gmsh); for bars, give intervals");
}

std::vector<std::vector<Vector3>> drawn_curves(const CaseFile& input, const std::string& key,
                                               const std::string& name, const Body& body) {
  const Group& group = find_drawn(input, key, name, body, &Group::lines, "Curve");
  try {
    std::vector<std::vector<Vector3>> curves = curves_of(group.line_points, group.lines);
    if (!curves.empty()) return curves;
  } catch (const std::invalid_argument& error) {
    throw InputError(input.where(key), fmt::format("is {}, which {}", quoted(name), error.what()),
                     "draw every line once; Coherence in gmsh joins coinciding curves");
  }
  throw InputError(input.where(key), fmt::format("is {}, whose lines have no length", quoted(name)),
                   "");
}

std::vector<Crack> drawn_faces(const CaseFile& input, const std::string& key,
                               const std::string& name, const Body& body) {
  const Group& group = find_drawn(input, key, name, body, &Group::sides,
                                  body.particles.dim == 2 ? "Curve" : "Surface");
  refuse_loose_group(input, key, body, group);
  return faces_of_group(body, group);
}

std::string place_of_crack(const CaseFile& input, std::size_t entry) {
  return item_key("cracks", entry,
                  !input.cracks[entry].group.empty() ? "group"
                  : dimension_of(input.body) == 2    ? "points"
                                                     : "corners");
}

DrawnCracks drawn_cracks(const CaseFile& input, const Body& body) {
  DrawnCracks drawn;
  for (std::size_t k = 0; k < input.cracks.size(); ++k) {
    const std::string key = place_of_crack(input, k);
    const CrackSection& section = input.cracks[k];
    std::vector<Crack> own;
    if (section.group.empty()) {
      own.push_back({section.points});
      try {
        check_crack(own.front(), body.particles.dim);
      } catch (const std::invalid_argument& error) {
        throw InputError(input.where(key), error.what(), "");
      }
    } else if (body.particles.dim == 2) {
      for (auto& curve : drawn_curves(input, key, section.group, body)) {
        own.push_back({std::move(curve)});
      }
    } else {
      own = drawn_faces(input, key, section.group, body);
    }
    for (Crack& crack : own) crack.closes = section.closing;
    drawn.entry.resize(drawn.entry.size() + own.size(), k);
    std::ranges::move(own, std::back_inserter(drawn.cracks));
  }
  return drawn;
}

}  // namespace perilink
