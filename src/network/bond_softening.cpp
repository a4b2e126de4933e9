#include "network/bond_softening.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <stdexcept>
#include <vector>

#include "material/strength/bond_cell.hpp"
#include "material/strength/face_chain.hpp"
#include "network/bond_strength.hpp"
#include "network/lattice_neighbourhoods.hpp"

namespace perilink {
namespace {

/// Overshoot of the segments with which strengths are measured: the strength error is below 0.3 %.
constexpr double fine_overshoot = 0.02;

/// Returns the overshoot p for an error of strength; p raises the strength of strips by about 2 p^2
/// (docs/theory/softening.md).
double overshoot_of(double error) { return std::sqrt(0.5 * error); }

/// Relative change of beta at convergence, and the largest number of iterations; each adds a digit.
constexpr double same_factor = 1e-4;
constexpr int most_rounds = 30;

/// Returns the uniaxial modulus in the body's kinematics [force/length^2]; lateral stresses are
/// zero in the plane.
double uniaxial_modulus(const LameConstants& lame, int dim) {
  const auto& [lambda, mu] = lame;
  return dim == 2 ? 4.0 * mu * (lambda + mu) / (lambda + 2.0 * mu)
                  : mu * (3.0 * lambda + 2.0 * mu) / (lambda + mu);
}

/// Bonds of an interior particle, and the directions in which the cell is loaded.
struct Pulled {
  std::vector<CellBond> cell;
  std::vector<Vector3> directions;
  int dim;

  /// Returns the mean of cell_strength() over the directions.
  double strength(const BondLaw& law) const {
    double sum = 0.0;
    for (const Vector3& direction : directions) sum += cell_strength(cell, dim, direction, law);
    return sum / static_cast<double>(directions.size());
  }
  /// Returns the mean strength in tension or compression for a law with a compressive branch.
  double strength(const BondLaw& law, bool compressed) const {
    double sum = 0.0;
    for (const Vector3& direction : directions) {
      double most = 0.0;
      for (const CellPoint& point : cell_path(cell, dim, {direction, compressed}, law, 1.0)) {
        most = std::max(most, point.stress);
      }
      sum += most / cell_modulus(cell, dim, direction);
    }
    return sum / static_cast<double>(directions.size());
  }
};

/// Bonds across a plane face, one list per trial direction.
struct Parted {
  std::vector<std::vector<LayerBond>> directions;
  std::array<double, 2> sides;
  double held;
  double modulus;

  /// Returns the mean of `held` times face_strength() over the modulus, over the directions.
  double strength(const BondLaw& law) const {
    double sum = 0.0;
    for (const auto& bonds : directions) sum += face_strength(bonds, sides, law);
    return held * sum / (modulus * static_cast<double>(directions.size()));
  }
};

/// Returns the stiffness of the bonds between a lattice particle of one material and its
/// neighbours.
NeighbourhoodStiffness bulk_stiffness(const Body& body, const NetworkInput& input,
                                      std::span<const Vector3> offsets) {
  if (body.lattice.surface == Surface::calibrated)
    return LatticeNeighbourhoods(body, input).stiffness(0);
  const MicropolarModuli moduli = moduli_of(body, input, input.materials.front());
  NeighbourhoodStiffness stiffness;
  for (const Vector3& x : offsets) {
    const double length = std::hypot(x[0], x[1], x[2]);
    const double share = std::pow(body.lattice.cell_volume, 2) / length;
    stiffness.axial.push_back(moduli.micromodulus * share);
    if (input.model != BondModel::micropolar) continue;
    stiffness.bending.push_back(12.0 * moduli.bending_modulus * share / (length * length));
  }
  return stiffness;
}

/// Lattices with more neighbours are treated as a continuum; the cost of loading bond by bond is
/// quadratic.
constexpr std::size_t many_neighbors = 1000;

/// Horizon over spacing of the lattice that replaces an unstructured particle set at a face.
constexpr double usual_ratio = 3.0;

/// Cosine of two degrees.
constexpr double nearly_along = 0.9994;

/// Lattices are loaded along their axes, as bodies usually are.
Pulled pulled_cell(const Body& body, const NetworkInput& input, const SolidMaterial& material) {
  const Lattice& lattice = body.lattice;
  const std::vector<Vector3> offsets = lattice.pattern == Pattern::irregular
                                           ? std::vector<Vector3>()
                                           : interior_neighbourhood(lattice, input.horizon).offsets;
  if (offsets.empty() || offsets.size() > many_neighbors) {
    const LameConstants lame = lame_constants(input, material);
    return {isotropic_cell(input.problem, lame.lambda / lame.mu), {{1.0, 0.0, 0.0}}, lattice.dim};
  }
  NetworkInput alone = input;
  alone.materials = {material};
  NeighbourhoodStiffness stiffness = bulk_stiffness(body, alone, offsets);
  for (std::size_t k = 0; k < stiffness.bending.size(); ++k) {
    stiffness.bending[k] /= stiffness.axial[k];
  }
  Pulled pulled{lattice_cell(offsets, stiffness.axial, stiffness.bending, lattice.cell_volume),
                {},
                lattice.dim};
  for (int axis = 0; axis < lattice.dim; ++axis) pulled.directions.emplace_back()[axis] = 1.0;
  return pulled;
}

/// Returns a lattice with a usual number of neighbours that replaces an unstructured particle set.
Body even_body(const Body& body, double horizon) {
  Body even;
  Lattice& lattice = even.lattice;
  lattice = body.lattice;
  lattice.pattern = lattice.dim == 2 ? Pattern::rectangular : Pattern::cubic;
  lattice.surface = Surface::calibrated;
  lattice.spacing = horizon / usual_ratio;
  lattice.step = {lattice.spacing, lattice.spacing, lattice.dim == 2 ? 0.0 : lattice.spacing};
  lattice.cell_volume =
      body.lattice.cell_volume * std::pow(lattice.spacing / body.lattice.spacing, lattice.dim);
  return even;
}

/// Returns the bond direction nearly parallel to a normal, since faces of lattices are normal to
/// bonds.
std::optional<Vector3> snapped(std::span<const Vector3> offsets, const Vector3& normal) {
  for (const auto& [x, y, z] : offsets) {
    const double length = std::hypot(x, y, z);
    const double cosine = (x * normal[0] + y * normal[1] + z * normal[2]) / length;
    if (cosine > nearly_along) return Vector3{x / length, y / length, z / length};
  }
  return std::nullopt;
}

/// A face not parallel to any layer of particles is tried along all axes.
Parted parted_body(const Body& body, const NetworkInput& input, const SolidMaterial& material,
                   const FaceShape& face) {
  std::vector<Vector3> offsets;
  if (body.lattice.pattern != Pattern::irregular) {
    offsets = interior_neighbourhood(body.lattice, input.horizon).offsets;
  }
  const bool particle_set = offsets.empty() || offsets.size() > many_neighbors;
  const Body even = particle_set ? even_body(body, input.horizon) : Body{};
  const Body& own = particle_set ? even : body;
  if (particle_set) offsets = interior_neighbourhood(own.lattice, input.horizon).offsets;
  NetworkInput alone = input;
  alone.materials = {material};
  NeighbourhoodStiffness stiffness = bulk_stiffness(own, alone, offsets);
  for (std::size_t k = 0; k < stiffness.bending.size(); ++k) {
    stiffness.bending[k] /= stiffness.axial[k];
  }
  Parted parted{{},
                face.sides,
                face.held,
                uniaxial_modulus(lame_constants(input, material), own.lattice.dim)};
  const auto part = [&](const Vector3& normal) {
    auto bonds =
        layer_bonds(offsets, stiffness.axial, stiffness.bending, own.lattice.cell_volume, normal);
    if (bonds) parted.directions.push_back(std::move(*bonds));
  };
  const std::optional<Vector3> normal =
      face.normal && !particle_set ? snapped(offsets, *face.normal) : std::nullopt;
  if (normal) part(*normal);
  for (int axis = 0; axis < own.lattice.dim && parted.directions.empty(); ++axis) {
    Vector3 along{};
    along[axis] = 1.0;
    part(along);
  }
  return parted;
}

bool softens(const SolidMaterial& material) {
  return material.softening.shape.kind != Softening::brittle;
}

/// Returns the tensile strength over the product of modulus and s_0 [-], or the compressive
/// strength for laws with a compressive branch.
using StrengthFactor = std::function<double(const BondLaw&, bool compressed)>;

/// Returns the energy 2 G_s / s_0^2 of bonds with the prescribed strength.
/// \param unit_energy  energy at beta = 1
double find_energy(const StrengthFactor& factor_of, const SofteningShape& shape,
                   double unit_energy) {
  double factor = 1.0;
  for (int round = 0; round < most_rounds; ++round) {
    const double energy = unit_energy * factor * factor;
    if (!(energy > 1.0 && energy < most_softening)) throw TooStrong(no_index, energy);
    const double next =
        factor_of(saw_tooth_of(SofteningCurve(shape, energy), fine_overshoot), false);
    const bool same = std::abs(next - factor) < same_factor * next;
    factor = next;
    if (same) break;
  }
  return unit_energy * factor * factor;
}

/// Returns the law with saw-tooth segments; concrete also has a compressive branch.
BondLaw law_of(const SofteningMaterial& softening, double energy, double overshoot) {
  const BondLaw law = saw_tooth_of(SofteningCurve(softening.shape, energy), overshoot);
  if (softening.shape.kind != Softening::concrete) return law;
  const auto& [limit, end] = softening.crushing;
  const SofteningCurve crushing(softening.shape, softening_energy(softening.shape, end / limit));
  return law.crushing(segments_of(crushing, overshoot), limit / softening.stretches[0],
                      !softening.shear_softens);
}

/// Returns the law and the strength of bonds.
/// \param modulus  reference modulus of the strength factor [force/length^2]
MaterialBonds bonds_by(const StrengthFactor& factor_of, double modulus,
                       const SolidMaterial& material, double brittle_stretch) {
  const SofteningMaterial& softening = material.softening;
  BondLaw law = BondLaw::brittle();
  MaterialStrength strength;
  double energy = 1.0, first = brittle_stretch, end = 1.0, factor = 0.0;
  if (softens(material)) {
    if (softening.stretches[0] > 0.0) {
      first = softening.stretches[0];
      energy = softening_energy(softening.shape, softening.stretches[1] / first);
    } else {
      const double unit = softening.tensile_strength / (modulus * brittle_stretch);
      energy = find_energy(factor_of, softening.shape, 1.0 / (unit * unit));
      first = brittle_stretch / std::sqrt(energy);
    }
    law = law_of(softening, energy, overshoot_of(softening.error));
    end = SofteningCurve(softening.shape, energy).end();
    const BondLaw fine = law_of(softening, energy, fine_overshoot);
    factor = factor_of(fine, false);
    if (fine.crushes()) strength.compressive_strength = factor_of(fine, true) * modulus * first;
  } else {
    factor = factor_of(law, false);
  }
  strength.tensile_strength = factor * modulus * first;
  strength.fracture_energy =
      material.fracture_energy * energy * std::pow(first / brittle_stretch, 2);
  strength.process_zone =
      material.youngs_modulus * strength.fracture_energy / std::pow(strength.tensile_strength, 2);
  strength.first_stretch = first;
  strength.last_stretch = first * end;
  strength.segments = count_segments(law);
  return {material.softening.closes ? law.closing() : law, strength};
}

}  // namespace

Index count_segments(const BondLaw& law) {
  Index count = 0;
  while (law.segment(count).secant > 0.0) ++count;
  return count;
}

double energy_until(const BondLaw& law, double secant) {
  double energy = 0.0;
  for (int k = 0; law.segment(k).secant > secant; ++k) {
    const Segment segment = law.segment(k);
    energy += segment.limit * segment.limit * (segment.secant - law.segment(k + 1).secant);
  }
  return energy;
}

double dissipated_until(const Network& network, Index bond, double secant) {
  const double extension = network.critical_stretch[bond] * network.bonds.length(bond);
  return 0.5 * network.stiffness[bond] * extension * extension *
         energy_until(network.law(bond), secant);
}

TooStrong::TooStrong(Index number, double energy, double factor, const Vector3& at)
    : std::invalid_argument("the strength of a bond does not fit its fracture energy"),
      material(number),
      share(energy),
      scatter(factor),
      place(at) {}

MaterialBonds bonds_of_material(const Body& body, const NetworkInput& input,
                                const SolidMaterial& material, double brittle_stretch) {
  if (!body.spans.empty()) {  // all bonds of a beam have the same stretch
    return bonds_by([](const BondLaw&, bool) { return 1.0; }, material.youngs_modulus, material,
                    brittle_stretch);
  }
  const Pulled pulled = pulled_cell(body, input, material);
  const double modulus = uniaxial_modulus(lame_constants(input, material), pulled.dim);
  const auto factor_of = [&](const BondLaw& law, bool compressed) {
    return law.crushes() ? pulled.strength(law, compressed) : pulled.strength(law);
  };
  return bonds_by(factor_of, modulus, material, brittle_stretch);
}

MaterialBonds bonds_of_face(const Body& body, const NetworkInput& input, const FaceShape& face,
                            const SolidMaterial& material, double brittle_stretch) {
  const Parted parted = parted_body(body, input, material, face);
  const auto factor_of = [&](const BondLaw& law, bool) { return parted.strength(law); };
  return bonds_by(factor_of, parted.modulus, material, brittle_stretch);
}

}  // namespace perilink
