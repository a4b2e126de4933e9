#include "model/body/weak_faces.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>
#include <string_view>

#include "base/error.hpp"
#include "discretization/facet_geometry.hpp"
#include "discretization/mesh_faces.hpp"
#include "discretization/meshes/mesh_surfaces.hpp"
#include "io/case/case_schema.hpp"
#include "io/case/sections/laws/case_softening.hpp"
#include "io/text/toml_tree.hpp"
#include "model/body/mesh_input.hpp"

namespace perilink {
namespace {

/// Distance within which a particle lies inside a region, in spacings.
constexpr double on_side = 1e-6;

/// Fraction of the strain energy that may be dissipated; below it the units are probably
/// inconsistent.
constexpr double far = 1e-3;

/// Marks the particles of a region that the case names.
void mark(const CaseFile& input, const Body& body, const std::string& name, std::uint8_t side,
          std::vector<std::uint8_t>& sides) {
  const Region& region = *std::find_if(input.regions.begin(), input.regions.end(),
                                       [&](const Region& known) { return known.name == name; });
  const auto group = std::find_if(
      body.groups.rbegin(), body.groups.rend(),
      [&](const Group& known) { return !region.group.empty() && known.name == region.group; });
  if (group != body.groups.rend()) {
    for (const Index i : group->particles) sides[i] |= side;
    return;
  }
  for (Index i = 0; i < body.particles.size(); ++i) {
    if (body.particles.kind[i] != ParticleKind::solid) continue;
    if (region.contains(body.particles.position(i), on_side * body.lattice.spacing)) {
      sides[i] |= side;
    }
  }
}

std::string key_of(const CaseFile& input, std::size_t k, int dim) {
  const InterfaceSection& section = input.interfaces[k];
  const char* place = !section.between.empty() ? "between"
                      : !section.group.empty() ? "group"
                      : dim == 2               ? "points"
                                               : "corners";
  return item_key("interfaces", k, place);
}

/// Returns the physical curves or surfaces of an interface.
const Group& group_of_face(const CaseFile& input, std::size_t k, const Body& body) {
  const std::string& name = input.interfaces[k].group;
  std::vector<std::string_view> names;
  for (const Group& group : body.groups) {
    if (group.sides.empty()) continue;
    if (group.name == name) {
      refuse_loose_lines(input, item_key("interfaces", k, "group"), body, group);
      return group;
    }
    names.push_back(group.name);
  }
  const char* kind = body.particles.dim == 2 ? "Curve" : "Surface";
  throw InputError(
      input.where(item_key("interfaces", k, "group")),
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

/// Returns the facets of a group with a common positive side. A particle between two materials
/// belongs to the later one, and lies on its side; a particle on the surface lies inside.
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

std::vector<WeakInterface> weak_interfaces(const CaseFile& input, const Body& body) {
  std::vector<WeakInterface> faces;
  if (input.analysis.type == AnalysisType::elastic) return faces;
  for (std::size_t k = 0; k < input.interfaces.size(); ++k) {
    const InterfaceSection& section = input.interfaces[k];
    // Laws given by stretches ignore the energy.
    const double energy = has_stretches(section.softening) ? 1.0 : section.fracture_energy;
    WeakInterface face{{}, {{section.points}}, energy, section.softening};
    if (!section.group.empty()) {
      face.faces = faces_of_group(body, group_of_face(input, k, body));
    } else if (!section.between.empty()) {
      face.side.assign(static_cast<std::size_t>(body.particles.size()), 0);
      mark(input, body, section.between[0], 1, face.side);
      mark(input, body, section.between[1], 2, face.side);
    } else {
      try {
        check_crack(face.faces[0], body.particles.dim);
      } catch (const std::invalid_argument& error) {
        throw InputError(input.where(key_of(input, k, body.particles.dim)), error.what(), "");
      }
    }
    faces.push_back(std::move(face));
  }
  return faces;
}

void refuse_interfaces_without_bonds(const CaseFile& input, const Network& network) {
  for (std::size_t k = 0; k < network.interfaces.size(); ++k) {
    if (network.interfaces[k].count > 0) continue;
    const bool regions = !input.interfaces[k].between.empty();
    throw InputError(
        input.where(key_of(input, k, network.dim())),
        regions ? "names two regions without a bond between them" : "crosses no bond of the body",
        regions ? "name regions that touch; particles in both belong to the second"
        : input.interfaces[k].group.empty() ? "move the line or plane into the body, or delete it"
                                            : "name a group that lies inside the body");
  }
}

namespace {

/// Refuses a scatter that gives some bonds a strength that does not fit their fracture energy.
[[noreturn]] void refuse_scatter(const CaseFile& input, const NetworkInput& network,
                                 const TooStrong& error) {
  std::size_t k = 0;  // the bond may lie between this material and another one that scatters
  while (k < network.random.size() && network.random[k].scatters[error.material] == 0) ++k;
  if (k == network.random.size()) k = 0;
  const SourceLocation where = input.where(item_key("random", k, "variation"));
  const double variation = network.random[k].field.variation;
  if (error.share > 1.0) {
    throw InputError(where,
                     fmt::format("is {:g}, which makes bonds so weak that they dissipate {:.3g} "
                                 "times the energy that they store at their strength; at most {:g} "
                                 "times are possible",
                                 variation, error.share, most_softening),
                     "give less");
  }
  throw InputError(where,
                   fmt::format("is {:g}, which makes bonds so strong that with a horizon of {:.6g} "
                               "they store {:.3g} times the energy that they may dissipate",
                               variation, network.horizon, 1.0 / error.share),
                   "give less, or take a smaller horizon; a table for the other property with "
                   "equal seed and correlation_length makes strong bonds tough");
}

}  // namespace

void refuse_unfit_strength(const CaseFile& input, const NetworkInput& network,
                           const TooStrong& error) {
  if (error.scatter != 1.0) refuse_scatter(input, network, error);
  const auto count = static_cast<Index>(network.materials.size());
  const bool is_face = error.material >= count;
  const auto k = static_cast<std::size_t>(is_face ? error.material - count : error.material);
  const char* table = is_face ? "interfaces" : "materials";
  const double strength = is_face ? network.interfaces[k].softening.tensile_strength
                                  : network.materials[k].softening.tensile_strength;
  if (error.share > 1.0) {
    const double energy =
        is_face ? network.interfaces[k].fracture_energy : network.materials[k].fracture_energy;
    throw InputError(
        input.where(item_key(table, k, "fracture_energy")),
        fmt::format("is {:.6g}, {:.3g} times the energy that a bond with a horizon of "
                    "{:.6g} stores at tensile_strength = {:.6g}; at most {:g} times are "
                    "possible",
                    energy, error.share, network.horizon, strength, most_softening),
        "give less, or a larger tensile_strength; are the numbers in units of one system?");
  }
  throw InputError(
      input.where(item_key(table, k, "tensile_strength")),
      fmt::format("is {:.6g}, but with a horizon of {:.6g} a bond would store {:.3g} "
                  "times the energy at this stress that it may dissipate by "
                  "fracture_energy",
                  strength, network.horizon, 1.0 / error.share),
      fmt::format("take a horizon below {:.4g}, a strength below {:.4g} or a larger "
                  "fracture_energy; the strength of brittle bonds follows from the "
                  "horizon{}",
                  network.horizon * error.share, strength * std::sqrt(error.share),
                  error.share < far ? "; are the numbers in units of one system?" : ""));
}

}  // namespace perilink
