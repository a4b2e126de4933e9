#include "network/weak_interfaces.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>

#include "discretization/cuts/cracks.hpp"
#include "material/critical_stretch.hpp"
#include "material/principal_values.hpp"
#include "network/bond_softening.hpp"
#include "network/bond_strength.hpp"

namespace perilink {
namespace {

/// A face is plane if its projection along the mean normal has at least this fraction of its area.
constexpr double plane = 0.98;

/// Rounds of averaging over neighbours across the face, for normals and sums at particles.
constexpr int rounds_of_spreading = 3;

/// Bonds up to this length, in spacings, show the materials on either side of a face.
constexpr double short_bonds = 1.5;

/// Mark of particles in both regions of a face.
constexpr std::uint8_t both_sides = 3;

/// Steps in the logarithm of the stiffness along a face; each step has its own law.
constexpr double step_of_places = 0.05;

/// Returns the bonds that cross the face if particles in both regions are on the given side.
std::vector<Index> crossing_bonds(const Body& body, const WeakInterface& face, std::uint8_t shared,
                                  const Network& network) {
  std::vector<Index> crossing;
  std::vector<std::uint8_t> keep;
  if (face.side.empty()) {
    keep = find_cut_bonds(network.particles, network.bonds, face.faces, body.lattice.spacing).keep;
  }
  const auto side = [&](Index i) -> int {
    if (i >= static_cast<Index>(face.side.size())) return 0;
    return face.side[i] == both_sides ? shared : face.side[i];
  };
  const bool has_bars = network.first_slip_spring > 0;
  const Index count = has_bars ? network.num_bonds() : network.bonds.size();
  for (Index e = 0; e < count; ++e) {
    const bool crosses = face.side.empty()
                             ? keep[e] == 0
                             : side(network.bonds.first[e]) + side(network.bonds.second[e]) == 3;
    if (crosses) crossing.push_back(e);
  }
  return crossing;
}

/// Returns the materials at the ends of a bond. A ghost, always the second end, has the material of
/// the solid particle.
std::array<Index, 2> materials_at(const Network& network, Index bond) {
  const std::vector<Index>& material = network.particles.material;
  const Index first = material[network.bonds.first[bond]];
  const Index second = material[network.bonds.second[bond]];
  return {first, second == no_index ? first : second};
}

/// Returns whether the face may be at either side of shared particles. It may not if the regions
/// share more than joints of materials; the second region then begins at the face.
bool can_turn(const NetworkInput& input, const WeakInterface& face, const Network& network) {
  if (input.materials.size() < 2) return false;
  std::vector<std::uint8_t> in_joint(static_cast<std::size_t>(network.particles.size()), 0);
  const Facets& facets = network.facets;
  for (Index f = 0; f < facets.size(); ++f) {
    if (facets.on_surface(f) || facets.inside[f] == facets.outside[f]) continue;
    for (const Index i : facets.corners.row(f)) in_joint[i] = 1;
  }
  for (std::size_t i = 0; i < face.side.size(); ++i) {
    if (face.side[i] == both_sides && in_joint[i] == 0) return false;
  }
  return true;
}

Vector3 direction_of(const Network& network, Index bond) {
  Vector3 n{};
  const auto direction = network.bonds.direction(bond);
  std::copy(direction.begin(), direction.end(), n.begin());
  return n;
}

double cosine_between(const Vector3& a, const Vector3& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/// Sums over bonds that cross a face.
using Sums = std::array<double, 6>;

void add(const Sums& other, Sums& sums) {
  for (std::size_t a = 0; a < sums.size(); ++a) sums[a] += other[a];
}

/// Returns sums at each particle with crossing bonds, including the sums of its neighbours along
/// such bonds.
/// \param own  returns the sums of a bond
template <class Own>
std::map<Index, Sums> sums_along_face(const Network& network, std::span<const Index> crossing,
                                      Own own) {
  std::map<Index, Sums> sums;
  for (const Index e : crossing) {
    const Sums added = own(e);
    add(added, sums[network.bonds.first[e]]);
    add(added, sums[network.bonds.second[e]]);
  }
  for (int round = 0; round < rounds_of_spreading; ++round) {
    const std::map<Index, Sums> before = sums;
    for (const Index e : crossing) {
      const Index i = network.bonds.first[e], j = network.bonds.second[e];
      add(before.at(i), sums.at(j));
      add(before.at(j), sums.at(i));
    }
  }
  return sums;
}

/// Stiffness of the bonds at a location of a face, over that with mean constants in all materials
/// [-].
struct Place {
  double force = 1.0;   ///< from sums of k xi, for the force
  double energy = 1.0;  ///< from sums of k xi^2, for the energy
  auto operator<=>(const Place&) const = default;
};

/// Properties of a face from the bonds that cross it.
struct Face {
  double area = 0.0;          ///< [length^2]
  double fracture_sum = 0.0;  ///< sum of k xi^2 times held_at_the_end(), over the area
                              ///< [force/length]
  double held = 1.0;          ///< mean of held_at_the_end()
  Vector3 axis{};             ///< mean normal
  bool plane = false;
  SolidMaterial material;  ///< mean constants of the bonds, with the law of the face
  std::map<Place, std::vector<Index>> places;  ///< bonds by location
};

/// Axial stiffness of a bond [force/length], and its bending stiffness over the axial one [-].
struct BondStiffnesses {
  double axial = 0.0, bending = 0.0;
};

/// Measures a face by the bonds that cross it.
class Measure {
 public:
  Measure(const NetworkInput& input, const Network& network, const EvenBonds& even,
          std::span<const Index> crossing)
      : input_(input), network_(network), even_(even), crossing_(crossing) {
    for (const SolidMaterial& material : input.materials) {
      const auto [lambda, mu] = lame_constants(input, material);
      dilatation_.push_back(network.dim() * lambda + 2.0 * mu);
    }
  }

  Face face();

 private:
  BondStiffnesses stiffness_of(Index bond) const;
  BondStiffnesses even_stiffness(Index bond) const;
  double held_at_the_end(Index bond, double cosine, double bending) const;
  void mix(Face& face);
  void measure_area(Face& face);
  void find_places(Face& face) const;

  const NetworkInput& input_;
  const Network& network_;
  const EvenBonds& even_;
  std::span<const Index> crossing_;
  std::vector<double> dilatation_;  ///< stress of a unit uniform dilatation, per material
  double stress_ = 0.0;             ///< mean over the bonds
  std::map<Index, double> cosine_;  ///< cosine between each bond and its normal
};

/// Computes the mean constants over the ends of the bonds.
void Measure::mix(Face& face) {
  std::vector<double> parts(input_.materials.size(), 0.0);
  for (const Index e : crossing_) {
    for (const Index m : materials_at(network_, e)) {
      parts[m] += 0.5 / static_cast<double>(crossing_.size());
    }
  }
  for (std::size_t m = 0; m < parts.size(); ++m) {
    stress_ += parts[m] * dilatation_[m];
    face.material.youngs_modulus += parts[m] * input_.materials[m].youngs_modulus;
    face.material.poissons_ratio += parts[m] * input_.materials[m].poissons_ratio;
  }
}

BondStiffnesses Measure::stiffness_of(Index bond) const {
  const double axial = network_.stiffness[bond];
  return {axial, network_.carries_moments() ? network_.bending[bond] / axial : 0.0};
}

/// Returns the stiffness of a bond with the mean constants in all materials.
BondStiffnesses Measure::even_stiffness(Index bond) const {
  if (even_.stiffness.empty()) return stiffness_of(bond);
  const double axial = even_.stiffness[bond];
  return {axial * (stress_ / dilatation_[0]),
          axial > 0.0 && !even_.bending.empty() ? even_.bending[bond] / axial : 0.0};
}

/// Returns the energy of a bond at breaking by an opening along the normal, over k xi^2 s_c^2 / 2
/// [-]. Bonds with moments break by the ratio k_b / k before calibration.
/// \param bending  present ratio of bending to axial stiffness [-]
double Measure::held_at_the_end(Index bond, double cosine, double bending) const {
  // Bonds without bending lie beside bars that bend.
  if (!network_.carries_moments() || network_.ratio_of_bending(bond) == 0.0) return 1.0;
  const double along = cosine * cosine, across = 1.0 - along;
  return (along + bending * across) / (along + network_.ratio_of_bending(bond) * across);
}

/// Measures area, normal and fracture sum. A unit uniform dilatation causes a stress of dim
/// lambda + 2 mu, and bonds carry k xi across the face; the ratio gives their area. The local
/// normal is the main axis of the crossing bonds at a bond's ends.
void Measure::measure_area(Face& face) {
  const int dim = network_.dim();
  const std::map<Index, Sums> axes = sums_along_face(network_, crossing_, [&](Index e) {
    const auto [x, y, z] = direction_of(network_, e);
    return Sums{x * x, y * y, z * z, x * y, y * z, z * x};
  });
  Sums mean{};
  for (const auto& own : axes) add(own.second, mean);
  face.axis = principal_direction(mean, dim);
  double along = 0.0, fracture_along = 0.0;  // seen along the mean normal
  double squares = 0.0;
  for (const Index e : crossing_) {
    Sums both = axes.at(network_.bonds.first[e]);
    add(axes.at(network_.bonds.second[e]), both);
    const Vector3 n = direction_of(network_, e);
    const double length = network_.bonds.length(e);
    const auto [stiffness, bending] = even_stiffness(e);
    const double area = stiffness * length / stress_, square = stiffness * length * length;
    const double own = std::abs(cosine_between(n, principal_direction(both, dim)));
    const double by_mean = std::abs(cosine_between(n, face.axis));
    cosine_[e] = own;
    face.area += area * own;
    along += area * by_mean;
    squares += square;
    face.fracture_sum += square * held_at_the_end(e, own, bending);
    fracture_along += square * held_at_the_end(e, by_mean, bending);
  }
  face.plane = along > plane * face.area;
  if (face.plane) {
    face.area = along;
    face.fracture_sum = fracture_along;
    for (auto& [e, cosine] : cosine_) {
      cosine = std::abs(cosine_between(direction_of(network_, e), face.axis));
    }
  }
  face.held = face.fracture_sum / squares;
}

/// Groups the bonds by local stiffness in few steps. In the mean over the groups the face keeps the
/// strength and energy for mean constants.
void Measure::find_places(Face& face) const {
  const auto own_sums = [&](Index e) {
    const double length = network_.bonds.length(e), along = std::pow(cosine_.at(e), 2);
    // Opening over length at an equivalent stretch of one.
    const double ratio = network_.carries_moments() ? network_.ratio_of_bending(e) : 0.0;
    const double opening = std::sqrt(along + ratio * (1.0 - along));
    Sums sums{};
    for (const bool even : {false, true}) {
      const auto [stiffness, bending] = even ? even_stiffness(e) : stiffness_of(e);
      const double held = stiffness * length * held_at_the_end(e, cosine_.at(e), bending);
      sums[even ? 1 : 0] = held * opening;
      sums[even ? 3 : 2] = held * length;
    }
    return sums;
  };
  const std::map<Index, Sums> sums = sums_along_face(network_, crossing_, own_sums);
  const auto in_steps = [](double ratio) {
    return std::exp(step_of_places * std::round(std::log(ratio) / step_of_places));
  };
  std::map<Place, std::vector<Index>> places;
  double force = 0.0, even_force = 0.0, energy = 0.0, even_energy = 0.0;
  for (const Index e : crossing_) {
    Sums both = sums.at(network_.bonds.first[e]);
    add(sums.at(network_.bonds.second[e]), both);
    const Place place{in_steps(both[0] / both[1]), in_steps(both[2] / both[3])};
    const Sums own = own_sums(e);
    force += own[0] / place.force;
    even_force += own[1];
    energy += own[2] / place.energy;
    even_energy += own[3];
    places[place].push_back(e);
  }
  for (auto& [place, bonds] : places) {
    face.places[{place.force * (force / even_force), place.energy * (energy / even_energy)}] =
        std::move(bonds);
  }
}

Face Measure::face() {
  Face face;
  mix(face);
  measure_area(face);
  find_places(face);
  face.fracture_sum /= face.area;
  return face;
}

/// Returns the mean Young's moduli behind a face and ahead of it (along its normal)
/// [force/length^2].
std::array<double, 2> moduli_beside(const NetworkInput& input, const Network& network,
                                    const EvenBonds& even, std::span<const Index> crossing,
                                    const Vector3& axis) {
  std::array<double, 2> moduli{};
  for (const Index e : crossing) {
    const double part =
        (even.modulus.empty() ? 1.0 : even.modulus[e]) / static_cast<double>(crossing.size());
    const bool along = cosine_between(axis, direction_of(network, e)) > 0.0;
    const auto [first, second] = materials_at(network, e);
    moduli[along ? 0 : 1] += part * input.materials[first].youngs_modulus;
    moduli[along ? 1 : 0] += part * input.materials[second].youngs_modulus;
  }
  return moduli;
}

/// Returns the law of the bonds at one location.
MaterialBonds bonds_of(const Body& body, const NetworkInput& input, const Network& network,
                       const EvenBonds& even, const Face& face, const Place& place,
                       std::span<const Index> crossing) {
  SolidMaterial material = face.material;
  material.youngs_modulus *= place.force;
  const auto [behind, ahead] = moduli_beside(input, network, even, crossing, face.axis);
  const double own = material.youngs_modulus;
  FaceShape shape{std::nullopt, {behind / own, ahead / own}, face.held};
  if (face.plane) shape.normal = face.axis;
  return bonds_of_face(
      body, input, shape, material,
      lattice_critical_stretch(material.fracture_energy, face.fracture_sum * place.energy));
}

}  // namespace

std::vector<Index> bonds_across(const Body& body, const NetworkInput& input,
                                const WeakInterface& face, const Network& network) {
  std::vector<Index> drawn = crossing_bonds(body, face, 2, network);
  if (drawn.empty() || !can_turn(input, face, network)) return drawn;
  WeakInterface turned = face;
  for (Crack& piece : turned.faces) std::reverse(piece.points.begin(), piece.points.end());
  const std::vector<Index> others = crossing_bonds(body, turned, 1, network);
  const auto modulus = [&](std::span<const Index> crossing) {
    double sum = 0.0, count = 0.0;
    for (const Index e : crossing) {
      if (network.bonds.length(e) > short_bonds * body.lattice.spacing) continue;
      for (const Index m : materials_at(network, e)) {
        sum += input.materials[m].youngs_modulus;
        count += 1.0;
      }
    }
    return count > 0.0 ? sum / count : infinity;
  };
  return modulus(others) < (1.0 - 1e-6) * modulus(drawn) ? others : drawn;
}

void weaken_interfaces(const Body& body, const NetworkInput& input, const EvenBonds& even,
                       Network& network) {
  for (std::size_t k = 0; k < input.interfaces.size(); ++k) {
    const WeakInterface& section = input.interfaces[k];
    const std::vector<Index> crossing = bonds_across(body, input, section, network);
    InterfaceBonds& own = network.report.interfaces.emplace_back();
    own.count = static_cast<Index>(crossing.size());
    if (crossing.empty()) continue;
    Face face = Measure(input, network, even, crossing).face();
    face.material.fracture_energy = section.fracture_energy;
    face.material.softening = section.softening;
    own.area = face.area;
    network.law_of.resize(network.stiffness.size(), 0);
    std::size_t most = 0;
    for (const auto& [place, bonds] : face.places) {
      try {
        const MaterialBonds made = bonds_of(body, input, network, even, face, place, bonds);
        if (bonds.size() > most) own.strength = made.strength;
        most = std::max(most, bonds.size());
        for (const Index e : bonds) {
          network.law_of[e] = static_cast<Index>(network.laws.size());
          network.critical_stretch[e] = made.strength.first_stretch;
        }
        network.laws.push_back(made.law);
      } catch (const TooStrong& error) {
        throw TooStrong(static_cast<Index>(input.materials.size() + k), error.share);
      }
    }
  }
}

}  // namespace perilink
