#include "network/builder/softened_bonds.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include "network/bond_softening.hpp"
#include "network/bond_strength.hpp"

namespace perilink {
namespace {

bool can_soften(const SolidMaterial& material) {
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
  SolidMaterial mean = can_soften(a) && can_soften(b) ? weaker : SolidMaterial{};
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

/// Width of the classes of laws where properties vary: difference of the logarithm of the fracture
/// energy times the modulus over the square of the strength, which determines the shape of a law.
constexpr double width_of_class = 0.02;

double energy_of_class(int number) { return std::exp(width_of_class * number); }

/// Bonds with one law.
struct LawKind {
  std::pair<Index, Index> materials;
  int energy_class = 0;  ///< with NetworkInput::fields
  /// The stretch where bonds of the same materials have different energies: in beams near ends, and
  /// in layers at joints. Slip springs have no such stretch.
  double stretch = 0.0;
  auto operator<=>(const LawKind&) const = default;
};

/// Sorts bonds and slip springs by their laws.
class LawKinds {
 public:
  LawKinds(const NetworkInput& input, const Network& network)
      : input_(input), network_(network), factors_(property_factors(input, network)) {}

  LawKind of(Index element) const;
  bool softens(const LawKind& kind) const {
    return can_soften(input_.materials[kind.materials.first]) &&
           can_soften(input_.materials[kind.materials.second]);
  }
  bool vary() const { return !factors_.strength.empty(); }
  /// Returns the factor on the reference stretch of an element's law: stretch is stress over
  /// modulus.
  double factor(Index element, const LawKind& kind) const {
    if (!varies(element, kind)) return 1.0;
    const double modulus = factors_.modulus[element];
    return softens(kind) ? factors_.strength[element] / modulus
                         : std::sqrt(factors_.energy[element] / modulus);
  }

 private:
  /// Returns whether the law follows the factors; laws by stretches do not.
  bool varies(Index element, const LawKind& kind) const {
    return element < static_cast<Index>(factors_.strength.size()) &&
           input_.materials[kind.materials.first].softening.stretches[0] == 0.0 &&
           input_.materials[kind.materials.second].softening.stretches[0] == 0.0;
  }

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
  if (varies(element, kind) && softens(kind)) {
    const double strength = factors_.strength[element];
    const double energy = factors_.energy[element] * factors_.modulus[element];
    kind.energy_class =
        static_cast<int>(std::lround(std::log(energy / (strength * strength)) / width_of_class));
  }
  return kind;
}

Vector3 middle_of(const Network& network, Index element) {
  const Particles& places = network.places();
  Vector3 middle{};
  for (const Index i : {network.bonds.first[element], network.bonds.second[element]}) {
    for (int a = 0; a < places.dim; ++a) middle[a] += 0.5 * places.position(i)[a];
  }
  return middle;
}

/// Returns the laws of all bonds, and those with the values of the materials.
std::map<LawKind, MaterialBonds> laws_of(const Body& body, const NetworkInput& input,
                                         const LawKinds& kinds, const Network& network) {
  std::map<LawKind, MaterialBonds> laws;
  for (Index e = 0; e < network.first_slip_spring; ++e) {
    if (!network.has_limit(e)) continue;
    LawKind kind = kinds.of(e);
    if (laws.contains(kind)) continue;
    const auto [a, b] = kind.materials;
    const SolidMaterial mean = mean_of(input.materials[a], input.materials[b]);
    if (!can_soften(mean) && !mean.softening.closes && !input.is_draft()) continue;
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
        throw TooStrong(a, error.share, energy, middle_of(network, e));
      }
    }
  }
  return laws;
}

}  // namespace

void soften_bonds(const Body& body, const NetworkInput& input, Network& network) {
  const LawKinds kinds(input, network);
  const std::map<LawKind, MaterialBonds> laws = laws_of(body, input, kinds, network);
  network.report.strengths.resize(input.materials.size());
  std::map<LawKind, Index> number;
  for (const auto& [kind, bonds] : laws) {
    const auto [a, b] = kind.materials;
    const bool mean = a == b && kind.energy_class == 0;
    if (mean && network.report.strengths[a].segments == 0)
      network.report.strengths[a] = bonds.strength;
    if (bonds.law.is_brittle()) continue;
    number[kind] = static_cast<Index>(network.laws.size());
    network.laws.push_back(bonds.law);
  }
  if (!number.empty()) network.law_of.resize(network.stiffness.size(), 0);
  if (number.empty() && !kinds.vary()) return;
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
