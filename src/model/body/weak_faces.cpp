#include "model/body/weak_faces.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <tuple>
#include <vector>

#include "base/error.hpp"
#include "base/plain_text.hpp"
#include "discretization/facet_geometry.hpp"
#include "discretization/mesh_faces.hpp"
#include "discretization/neighbor_search.hpp"
#include "io/case/case_schema.hpp"
#include "io/case/case_words.hpp"
#include "io/case/sections/laws/case_softening.hpp"
#include "model/body/groups/drawn_groups.hpp"

namespace perilink {
namespace {

/// Distance within which a particle lies inside a region, in spacings.
constexpr double on_side = 1e-6;

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

/// Refuses regions with particles of the body between them.
/// \param side  per particle: 1 and 2 in one of the regions, 3 in both
void refuse_apart(const CaseFile& input, std::size_t k, const Particles& particles,
                  std::span<const std::uint8_t> side) {
  constexpr double way_round = 1.2;  // over the distance of the nearest two particles
  const auto at = [&](Index i) { return point_of(particles.positions, particles.dim, i); };
  std::vector<double> positions;
  std::vector<Index> first, second;
  for (Index i = 0; i < particles.size(); ++i) {
    if (side[i] == 3) return;
    if (side[i] == 2) second.push_back(i);
    if (side[i] != 1) continue;
    const auto x = particles.position(i);
    positions.insert(positions.end(), x.begin(), x.end());
    first.push_back(i);
  }
  if (first.empty() || second.empty()) return;
  const NearestPoint nearest(std::move(positions), particles.dim);
  Vector3 from{}, to{};
  double least = infinity;
  for (const Index j : second) {
    const Vector3 other = at(first[nearest.at(particles.position(j))]);
    const double distance = norm(minus(at(j), other));
    if (distance < least) std::tie(least, from, to) = std::tuple(distance, other, at(j));
  }
  for (Index i = 0; i < particles.size(); ++i) {
    if (particles.kind[i] != ParticleKind::solid || side[i] != 0) continue;
    const double way = norm(minus(at(i), from)) + norm(minus(at(i), to));
    if (way > way_round * least) continue;
    throw InputError(input.where(key_of(input, k, particles.dim)),
                     "names two regions with particles between them",
                     "name regions that touch; particles in both belong to the second");
  }
}

/// Returns the coordinate of a plane of symmetry; empty for a region without particles.
std::optional<double> place_of_plane(const CaseFile& input, const Body& body,
                                     const SymmetrySection& plane) {
  if (plane.at) return plane.at;
  if (std::ranges::find(input.regions, plane.region, &Region::name) == input.regions.end())
    return {};
  std::vector<std::uint8_t> inside(static_cast<std::size_t>(body.particles.size()), 0);
  mark(input, body, plane.region, 1, inside);
  const auto first = std::ranges::find(inside, 1) - inside.begin();
  if (first == std::ssize(inside)) return {};
  return body.particles.position(static_cast<Index>(first))[plane.axis];
}

/// Whether some points lie within a distance of a plane, and reach farther along it than across.
bool lie_along(std::span<const Vector3> points, int axis, double at, double room) {
  Vector3 lower{infinity, infinity, infinity}, upper{-infinity, -infinity, -infinity};
  for (const Vector3& point : points) {
    if (std::abs(point[axis] - at) > room) return false;
    for (int a = 0; a < 3; ++a) {
      lower[a] = std::min(lower[a], point[a]);
      upper[a] = std::max(upper[a], point[a]);
    }
  }
  const Vector3 reach = minus(upper, lower);
  return *std::ranges::max_element(reach) > reach[axis];
}

/// Whether a part of an interface lies along a plane, or one of its sides is in the plane.
bool lies_along(const WeakInterface& face, const Body& body, int axis, double at, double room) {
  for (const Crack& crack : face.faces) {
    const std::span<const Vector3> points = crack.points;
    const bool is_line = body.particles.dim == 2;
    for (std::size_t k = 0; is_line && k + 1 < points.size(); ++k) {
      if (lie_along(points.subspan(k, 2), axis, at, room)) return true;
    }
    if (!is_line && !points.empty() && lie_along(points, axis, at, room)) return true;
  }
  std::array<bool, 2> beyond{}, any{};  // particles of each side off the plane, and at all
  for (std::size_t i = 0; i < face.side.size(); ++i) {
    if (face.side[i] == 0) continue;
    const std::size_t side = face.side[i] == 1 ? 0 : 1;
    const double away = std::abs(body.particles.position(static_cast<Index>(i))[axis] - at);
    any[side] = true;
    beyond[side] = beyond[side] || away > room;
  }
  return (any[0] && !beyond[0]) || (any[1] && !beyond[1]);
}

/// Refuses an interface along a plane of symmetry. Its bonds end at particles in the plane and have
/// the energy of both halves.
void refuse_on_symmetry(const CaseFile& input, std::size_t k, const Body& body,
                        const WeakInterface& face) {
  const double room = (0.5 + on_side) * body.lattice.spacing;
  for (std::size_t p = 0; p < input.symmetry.size(); ++p) {
    const SymmetrySection& plane = input.symmetry[p];
    const auto at = place_of_plane(input, body, plane);
    if (!at || !lies_along(face, body, plane.axis, *at, room)) continue;
    throw InputError(
        input.where(key_of(input, k, body.particles.dim)),
        fmt::format("lies along the plane of symmetry of symmetry[{}], {} = {:.6g}: the half body "
                    "would take the whole fracture energy of the interface, so that peak and "
                    "energy would be too high, by up to a factor of 2",
                    p + 1, axis_names[plane.axis], *at),
        "model the whole body");
  }
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
      face.faces = drawn_faces(input, item_key("interfaces", k, "group"), section.group, body);
    } else if (!section.between.empty()) {
      face.side.assign(static_cast<std::size_t>(body.particles.size()), 0);
      mark(input, body, section.between[0], 1, face.side);
      mark(input, body, section.between[1], 2, face.side);
      refuse_apart(input, k, body.particles, face.side);
    } else {
      try {
        check_crack(face.faces[0], body.particles.dim);
      } catch (const std::invalid_argument& error) {
        throw InputError(input.where(key_of(input, k, body.particles.dim)), error.what(), "");
      }
    }
    refuse_on_symmetry(input, k, body, face);
    faces.push_back(std::move(face));
  }
  return faces;
}

void refuse_interfaces_without_bonds(const CaseFile& input, const Network& network) {
  for (std::size_t k = 0; k < network.report.interfaces.size(); ++k) {
    if (network.report.interfaces[k].count > 0) continue;
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

/// Refuses a formula that gives some bonds a strength that does not fit their fracture energy.
[[noreturn]] void refuse_formula(const SourceLocation& where, const PropertyField& field,
                                 double horizon, const TooStrong& error, int dim) {
  const std::span<const double> place = std::span(error.place).first(static_cast<std::size_t>(dim));
  const bool weak = error.share > 1.0;
  throw InputError(
      where,
      fmt::format("is {:.6g} at the position ({}), where bonds with a horizon of {:.6g} {} {:.3g} "
                  "times the energy that they {}",
                  field.factor(place), joined(place), horizon,
                  weak ? "would dissipate" : "would store at their strength",
                  weak ? error.share : 1.0 / error.share,
                  weak ? fmt::format("store at their strength; at most {:g} times are possible",
                                     most_softening)
                       : "may dissipate"),
      "the strength squared over modulus times fracture energy must fit the horizon everywhere: "
      "grade another property too, or take another horizon");
}

/// Refuses a field that gives some bonds a strength that does not fit their fracture energy.
[[noreturn]] void refuse_field(const CaseFile& input, const NetworkInput& network,
                               const TooStrong& error) {
  // The bond may lie between this material and another one that varies. Fields of [[random]] come
  // first.
  const auto varies = [&](const PropertyField& field) {
    return field.varies[static_cast<std::size_t>(error.material)] != 0;
  };
  const auto graded =
      network.fields.begin() + static_cast<std::ptrdiff_t>(input.fields.random.size());
  auto formula = std::find_if(graded, network.fields.end(), varies);
  if (input.fields.random.empty()) formula = std::min(formula, network.fields.end() - 1);
  if (formula != network.fields.end()) {
    const auto entry = static_cast<std::size_t>(formula - graded);
    const std::string key =
        item_key("graded", entry, input.fields.graded[entry].file ? "file" : "factor");
    refuse_formula(input.where(key), *formula, network.horizon, error,
                   dimension_of(network.problem));
  }
  std::size_t k = 0;
  while (k < input.fields.random.size() && !varies(network.fields[k])) ++k;
  if (k == input.fields.random.size()) k = 0;
  const SourceLocation where = input.where(item_key("random", k, "variation"));
  const double variation = network.fields[k].random.variation;
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
  if (error.scatter != 1.0) refuse_field(input, network, error);
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
      fmt::format("take a horizon below {:.4g}, a strength below {:.4g}, or a larger "
                  "fracture_energy or youngs_modulus; are the numbers in units of one system?",
                  network.horizon * error.share, strength * std::sqrt(error.share)));
}

}  // namespace perilink
