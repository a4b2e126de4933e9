#include "calibration/bond_orbits.hpp"

#include <cmath>
#include <unordered_map>
#include <unordered_set>

namespace perilink {
namespace {

/// Largest depth that distinguishes free bonds, over the reach of bonds.
constexpr Index counted_reaches = 2;

/// Largest reach whose depths and distances fit into the keys below.
constexpr Index longest_reach = 20;

using Steps = std::array<Index, 3>;
using Key = std::uint64_t;

/// Packs numbers of the three axes, each below 2^21, into one.
Key join(const std::array<Key, 3>& parts) { return parts[0] << 42 | parts[1] << 21 | parts[2]; }

class Symmetry {
 public:
  Symmetry(const LatticeBox& box, const Particles& particles, const Bonds& bonds);

  bool trivial() const { return trivial_; }
  Key bond(Index from, Index to) const;
  Key place(Index particle) const;

 private:
  void compare_axes();
  void turn(std::array<Key, 3>& parts) const;
  Index depth(Index particle, int axis, const Steps& limit) const {
    const Index k = steps_[particle][axis];
    return std::min({k, box_.count[axis] - k, limit[axis]});
  }

  const LatticeBox& box_;
  std::vector<Steps> steps_;  // per particle, from the lower corner
  Steps bond_limit_{};        // largest depth that distinguishes bonds
  Steps place_limit_{};
  std::array<int, 3> kind_ = {0, 1, 2};  // per axis; axes of one kind may be exchanged
  bool trivial_ = false;
};

Symmetry::Symmetry(const LatticeBox& box, const Particles& particles, const Bonds& bonds)
    : box_(box), steps_(static_cast<std::size_t>(particles.size())) {
  for (Index i = 0; i < particles.size(); ++i) {
    for (int a = 0; a < particles.dim; ++a) {
      const double place = (particles.position(i)[a] - box.lower[a]) / box.step[a];
      steps_[i][a] = static_cast<Index>(std::lround(place));
    }
  }
  Steps reach{};
  for (Index b = 0; b < bonds.size(); ++b) {
    for (int a = 0; a < 3; ++a) {
      const Index distance = steps_[bonds.second[b]][a] - steps_[bonds.first[b]][a];
      reach[a] = std::max(reach[a], std::abs(distance));
    }
  }
  for (int a = 0; a < 3; ++a) {
    trivial_ = trivial_ || reach[a] > longest_reach;
    bond_limit_[a] = counted_reaches * reach[a];
    place_limit_[a] = bond_limit_[a] + reach[a];
    if (box.count[a] <= 2 * place_limit_[a]) bond_limit_[a] = place_limit_[a] = box.count[a];
  }
  compare_axes();
}

/// Marks axes with equal steps as equivalent where the box is equally long along them, or long
/// enough.
void Symmetry::compare_axes() {
  for (int a = 1; a < 3; ++a) {
    for (int b = 0; b < a; ++b) {
      const bool equal_steps = std::abs(box_.step[a] - box_.step[b]) < 1e-9 * box_.step[a];
      if (equal_steps && place_limit_[a] == place_limit_[b] && bond_limit_[a] == bond_limit_[b]) {
        kind_[a] = kind_[b];
        break;
      }
    }
  }
}

/// Sorts the parts of equivalent axes.
void Symmetry::turn(std::array<Key, 3>& parts) const {
  for (const auto& [a, b] : {std::pair(0, 1), std::pair(1, 2), std::pair(0, 2), std::pair(0, 1)}) {
    if (kind_[a] == kind_[b] && parts[a] > parts[b]) std::swap(parts[a], parts[b]);
  }
}

Key Symmetry::bond(Index from, Index to) const {
  std::array<Key, 3> parts{};
  for (int a = 0; a < 3; ++a) {
    const Key distance = static_cast<Key>(std::abs(steps_[to][a] - steps_[from][a]));
    parts[a] = static_cast<Key>(depth(from, a, bond_limit_)) << 14 |
               static_cast<Key>(depth(to, a, bond_limit_)) << 7 | distance;
  }
  turn(parts);
  return join(parts);
}

Key Symmetry::place(Index particle) const {
  std::array<Key, 3> parts{};
  for (int a = 0; a < 3; ++a) parts[a] = static_cast<Key>(depth(particle, a, place_limit_));
  turn(parts);
  return join(parts);
}

}  // namespace

std::optional<LatticeBox> lattice_box(const Body& body) {
  const Particles& particles = body.particles;
  const Pattern pattern = body.lattice.pattern;
  const bool in_space = pattern == Pattern::cubic || pattern == Pattern::face_centred;
  if ((!in_space && pattern != Pattern::rectangular) || particles.size() == 0) return std::nullopt;
  const Vector3& step = body.lattice.step;
  LatticeBox box;
  box.step = in_space ? step : Vector3{step[0], step[1], 1.0};
  double volume = in_space ? 1.0 : body.lattice.cell_volume / (step[0] * step[1]), filled = 0.0;
  for (int a = 0; a < particles.dim; ++a) {
    double lower = particles.position(0)[a], upper = lower;
    for (Index i = 0; i < particles.size(); ++i) {
      lower = std::min(lower, particles.position(i)[a]);
      upper = std::max(upper, particles.position(i)[a]);
    }
    box.lower[a] = lower;
    box.count[a] = static_cast<Index>(std::lround((upper - lower) / box.step[a]));
    volume *= upper - lower;
  }
  for (const double v : particles.volumes) filled += v;
  // Other boxes in the plane need no reduction: one factor solves them in a few iterations.
  if (!in_space && std::min(box.count[0], box.count[1]) > 1) return std::nullopt;
  // Less than half a cell may be missing; round-off is far below.
  if (std::abs(filled - volume) > 0.1 * body.lattice.cell_volume) return std::nullopt;
  return box;
}

BondOrbits find_orbits(const LatticeBox& box, const Particles& particles, const Bonds& bonds,
                       std::span<const std::uint8_t> free) {
  const Symmetry symmetry(box, particles, bonds);
  BondOrbits orbits;
  orbits.views.assign(static_cast<std::size_t>(bonds.size()), {no_index, no_index});
  if (symmetry.trivial()) return orbits;
  std::unordered_map<Key, Index> numbers;
  std::vector<std::uint8_t> touched(static_cast<std::size_t>(particles.size()), 0);
  const auto number = [&](Index from, Index to) {
    const Key key = symmetry.bond(from, to);
    return numbers.emplace(key, static_cast<Index>(numbers.size())).first->second;
  };
  for (Index b = 0; b < bonds.size(); ++b) {
    if (!free[b]) continue;
    const Index i = bonds.first[b], j = bonds.second[b];
    touched[i] = touched[j] = 1;
    orbits.views[b][0] = number(i, j);
    orbits.views[b][1] = number(j, i);
  }
  orbits.num_views = static_cast<Index>(numbers.size());
  std::unordered_set<Key> known;
  for (Index i = 0; i < particles.size(); ++i) {
    if (touched[i] && known.insert(symmetry.place(i)).second) orbits.representatives.push_back(i);
  }
  return orbits;
}

OrbitSample sample_orbits(const BondOrbits& orbits, Index num_particles, const Bonds& bonds,
                          std::span<const std::uint8_t> free, const BondStiffness& stiffness) {
  std::vector<std::uint8_t> represents(static_cast<std::size_t>(num_particles), 0);
  for (const Index i : orbits.representatives) represents[i] = 1;
  OrbitSample sample{sample_bonds(represents, bonds, free, stiffness), {}};
  sample.orbits.num_views = orbits.num_views;
  sample.orbits.representatives = orbits.representatives;
  for (const Index b : sample.numbers) sample.orbits.views.push_back(orbits.views[b]);
  return sample;
}

bool spread(const OrbitSample& sample, const BondStiffness& sampled, const BondOrbits& orbits,
            BondStiffness& stiffness) {
  std::vector<Index> leader(static_cast<std::size_t>(orbits.num_views), no_index);  // in sample
  for (Index s = 0; s < sample.bonds.size(); ++s) {
    if (sample.free[s] && leader[sample.orbits.of_bond(s)] == no_index) {
      leader[sample.orbits.of_bond(s)] = s;
    }
  }
  for (std::size_t b = 0; b < orbits.views.size(); ++b) {
    if (orbits.views[b][0] == no_index) continue;
    if (leader[orbits.of_bond(static_cast<Index>(b))] == no_index) return false;
  }
  for (std::size_t b = 0; b < orbits.views.size(); ++b) {
    if (orbits.views[b][0] == no_index) continue;
    const Index s = leader[orbits.of_bond(static_cast<Index>(b))];
    stiffness.axial[b] = sampled.axial[s];
    if (stiffness.bending.empty()) continue;
    const double inflection = sampled.inflection[s];
    const bool reversed = orbits.views[b][0] != sample.orbits.views[s][0];
    stiffness.bending[b] = sampled.bending[s];
    stiffness.inflection[b] = reversed ? 1.0 - inflection : inflection;
  }
  return true;
}

}  // namespace perilink
