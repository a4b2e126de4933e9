#include "network/bond_softening.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <optional>
#include <stdexcept>
#include <utility>
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

/// Returns the material of bonds between two materials: mean elastic constants, smaller strength
/// and fracture energy, and the curve of the weaker one. A given stretch takes precedence over a
/// missing one.
SolidMaterial mean_of(const SolidMaterial& a, const SolidMaterial& b) {
  const auto strength = [](const SolidMaterial& material) {
    return std::pair(material.softening.tensile_strength, material.softening.stretches[0]);
  };
  const SolidMaterial& weaker = strength(b) < strength(a) ? b : a;
  SolidMaterial mean = softens(a) && softens(b) ? weaker : SolidMaterial{};
  mean.softening.closes = a.softening.closes && b.softening.closes;
  mean.youngs_modulus = 0.5 * (a.youngs_modulus + b.youngs_modulus);
  mean.poissons_ratio = 0.5 * (a.poissons_ratio + b.poissons_ratio);
  mean.fracture_energy = energy_between(a, b);
  mean.softening.tensile_strength =
      std::min(a.softening.tensile_strength, b.softening.tensile_strength);
  mean.softening.shear_softens = a.softening.shear_softens && b.softening.shear_softens;
  for (int k = 0; k < 2; ++k) {
    const auto [least, most] = std::minmax(a.softening.stretches[k], b.softening.stretches[k]);
    mean.softening.stretches[k] = least > 0.0 ? least : most;
    mean.softening.crushing[k] = std::min(a.softening.crushing[k], b.softening.crushing[k]);
  }
  return mean;
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

/// Width of the classes of laws of random strength: difference of the logarithm of the fracture
/// energy over the square of the strength, which determines the shape of a law.
constexpr double width_of_class = 0.02;

double energy_of_class(int number) { return std::exp(width_of_class * number); }

Index count_segments(const BondLaw& law) {
  Index count = 0;
  while (law.segment(count).secant > 0.0) ++count;
  return count;
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

TooStrong::TooStrong(Index number, double energy, double random)
    : std::invalid_argument("the strength of a bond does not fit its fracture energy"),
      material(number),
      share(energy),
      scatter(random) {}

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

namespace {

/// Bonds with one law.
struct LawKind {
  std::pair<Index, Index> materials;
  int energy_class = 0;  ///< with NetworkInput::random
  /// The stretch where bonds of the same materials have different energies: in beams near ends, and
  /// in layers at joints. Slip springs have no such stretch.
  double stretch = 0.0;
  auto operator<=>(const LawKind&) const = default;
};

/// Sorts bonds and slip springs by their laws.
class LawKinds {
 public:
  LawKinds(const NetworkInput& input, const Network& network)
      : input_(input), network_(network), factors_(random_factors(input, network)) {}

  LawKind of(Index element) const;
  bool softens(const LawKind& kind) const {
    return perilink::softens(input_.materials[kind.materials.first]) &&
           perilink::softens(input_.materials[kind.materials.second]);
  }
  bool scatter() const { return !factors_.strength.empty(); }
  /// Returns the factor on the reference stretch of an element's law.
  double factor(Index element, const LawKind& kind) const {
    if (element >= static_cast<Index>(factors_.strength.size())) return 1.0;
    return softens(kind) ? factors_.strength[element] : std::sqrt(factors_.energy[element]);
  }

 private:
  const NetworkInput& input_;
  const Network& network_;
  BondFactors factors_;
};

LawKind LawKinds::of(Index element) const {
  const Index j = network_.bonds.second[element];
  LawKind kind;
  if (element < static_cast<Index>(network_.materials_of.size())) {
    const auto& [a, b] = network_.materials_of[element];
    kind.materials = std::minmax(a, b);
    kind.stretch = network_.critical_stretch[element];
  } else {
    const std::vector<Index>& material = network_.particles.material;
    // The particle between two beam segments belongs to the first one.
    const Index own = material[network_.is_beam() ? j : network_.bonds.first[element]];
    const bool solid = network_.particles.kind[j] == ParticleKind::solid;
    kind.materials = std::minmax(own, solid ? material[j] : own);
    if (network_.is_beam()) kind.stretch = network_.critical_stretch[element];
  }
  if (element < static_cast<Index>(factors_.strength.size()) && softens(kind)) {
    const double strength = factors_.strength[element];
    kind.energy_class = static_cast<int>(
        std::lround(std::log(factors_.energy[element] / (strength * strength)) / width_of_class));
  }
  return kind;
}

/// Returns the laws of all bonds, and those without scatter.
std::map<LawKind, MaterialBonds> laws_of(const Body& body, const NetworkInput& input,
                                         const LawKinds& kinds, const Network& network) {
  std::map<LawKind, MaterialBonds> laws;
  for (Index e = 0; e < network.first_slip_spring; ++e) {
    if (!network.has_limit(e)) continue;
    LawKind kind = kinds.of(e);
    if (laws.contains(kind)) continue;
    const auto [a, b] = kind.materials;
    const SolidMaterial mean = mean_of(input.materials[a], input.materials[b]);
    if (!softens(mean) && !mean.softening.closes && !input.draft) continue;
    for (const int number : {0, kind.energy_class}) {
      const double energy = energy_of_class(number);
      SolidMaterial own = mean;
      own.fracture_energy *= energy;
      kind.energy_class = number;
      if (laws.contains(kind)) continue;
      try {
        laws.insert({kind, bonds_of_material(body, input, own,
                                             network.critical_stretch[e] * std::sqrt(energy))});
      } catch (const TooStrong& error) {
        throw TooStrong(a, error.share, energy);
      }
    }
  }
  return laws;
}

}  // namespace

void soften_bonds(const Body& body, const NetworkInput& input, Network& network) {
  const LawKinds kinds(input, network);
  const std::map<LawKind, MaterialBonds> laws = laws_of(body, input, kinds, network);
  network.strengths.resize(input.materials.size());
  std::map<LawKind, Index> number;
  for (const auto& [kind, bonds] : laws) {
    const auto [a, b] = kind.materials;
    const bool mean = a == b && kind.energy_class == 0;
    if (mean && network.strengths[a].segments == 0) network.strengths[a] = bonds.strength;
    if (bonds.law.is_brittle()) continue;
    number[kind] = static_cast<Index>(network.laws.size());
    network.laws.push_back(bonds.law);
  }
  if (!number.empty()) network.law_of.resize(network.stiffness.size(), 0);
  if (number.empty() && !kinds.scatter()) return;
  for (Index e = 0; e < network.first_bar_element; ++e) {
    if (!network.has_limit(e)) continue;
    const LawKind kind = kinds.of(e);
    // Slip springs take the law with the least stretch, as bonds away from other materials do.
    const auto law = kind.stretch > 0.0 ? number.find(kind) : number.lower_bound(kind);
    if (law != number.end() && law->first.materials == kind.materials) {
      network.law_of[e] = law->second;
      network.critical_stretch[e] = laws.at(law->first).strength.first_stretch;
    }
    network.critical_stretch[e] *= kinds.factor(e, kind);
  }
}

}  // namespace perilink
