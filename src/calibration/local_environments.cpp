#include "calibration/local_environments.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <span>
#include <unordered_map>
#include <unordered_set>
#include <utility>

#include "base/csr.hpp"
#include "calibration/bond_sample.hpp"

namespace perilink {
namespace {

using Key = std::uint64_t;
using Offset = std::array<std::int64_t, 3>;

/// Particles are compared up to so many bonds away, bonds up to one bond less.
constexpr int place_rounds = 2;

/// Stiffnesses and area vectors that differ by less than this fraction of the largest are equal. A
/// power of two, so that halves and quarters are not rounded by chance.
constexpr double same = 0x1p-23;

/// Spreads the bits of a key over all of it (the finalizer of SplitMix64: Steele, Lea & Flood
/// 2014).
Key mix(Key key) {
  key = (key ^ key >> 30) * 0xbf58476d1ce4e5b9u;
  key = (key ^ key >> 27) * 0x94d049bb133111ebu;
  return key ^ key >> 31;
}

Key join(Key a, Key b) { return mix(a + 0x9e3779b97f4a7c15u * (b + 1)); }

Key join(Key key, const Offset& steps) {
  for (const std::int64_t s : steps) key = join(key, static_cast<Key>(s));
  return key;
}

/// A rotation or reflection that maps the lattice on itself: permutation and signs of the axes.
struct Turn {
  std::array<int, 3> axis;
  std::array<int, 3> sign;

  Offset operator()(const Offset& x) const {
    return {sign[0] * x[axis[0]], sign[1] * x[axis[1]], sign[2] * x[axis[2]]};
  }
};

/// Returns the rotations and reflections of the lattice, the identity first.
std::vector<Turn> turns_of(const Vector3& step) {
  std::vector<Turn> turns;
  std::array<int, 3> axis = {0, 1, 2};
  do {
    bool alike = true;
    for (int a = 0; a < 3; ++a) {
      alike = alike && std::abs(step[axis[a]] - step[a]) < 1e-9 * step[a];
    }
    if (!alike) continue;
    for (int mirrors = 0; mirrors < 8; ++mirrors) {
      Turn turn{axis, {}};
      for (int a = 0; a < 3; ++a) turn.sign[a] = (mirrors >> a & 1) ? -1 : 1;
      turns.push_back(turn);
    }
  } while (std::next_permutation(axis.begin(), axis.end()));
  return turns;
}

/// Rounds values to a fraction of the largest, so that equal values compare equal.
class Rounding {
 public:
  explicit Rounding(const std::vector<double>& values) : values_(values) {
    double most = 0.0;
    for (const double value : values) most = std::max(most, std::abs(value));
    if (most > 0.0) parts_ = 1.0 / (same * most);
  }
  std::int64_t operator[](std::size_t k) const { return std::llround(parts_ * values_[k]); }

 private:
  const std::vector<double>& values_;
  double parts_ = 1.0;
};

class LocalEnvironments {
 public:
  LocalEnvironments(const CalibrationInput& input, const Facets& facets,
                    const BondStiffness& stiffness);
  BondOrbits find(std::size_t most);

 private:
  using Views = std::vector<Key>;  // local environment per particle or per class
  /// A bond at the example of a class.
  struct Neighbour {
    Key label;
    Index offset, kind;  // offset and class of its other end
  };
  void number_offsets();
  void label_bonds(const BondStiffness& stiffness);
  void measure_areas(const Facets& facets);
  Views first_views(std::span<const Index> particles, const Turn& turn) const;
  Views turned_offsets(const Turn& turn) const;
  void sort_places();
  void find_neighbours();
  Key look_around(std::size_t kind, const Views& views, const Views& offsets) const;
  void turn_places();

  Index start(Index bond, bool reversed) const {
    return reversed ? input_.bonds.second[bond] : input_.bonds.first[bond];
  }
  Index offset(Index bond, bool reversed) const {
    return offset_of_[input_.bonds.kind_of(bond)] + reversed;
  }
  std::size_t seen(Index bond, bool reversed) const {
    return kind_[start(bond, reversed)] * offsets_.size() + offset(bond, reversed);
  }

  const CalibrationInput& input_;
  std::size_t size_;
  std::vector<Offset> offsets_;   // in steps, each followed by its reverse
  std::vector<Index> offset_of_;  // per translation class of bonds: its offset
  std::vector<Key> label_;        // per bond: stiffness, and whether it may change
  std::vector<Offset> area_;      // per particle
  std::vector<Key> on_surface_;   // per particle
  std::vector<Turn> turns_;
  std::vector<Index> kind_;     // per particle: class up to translations
  std::vector<Index> example_;  // a particle of each class
  std::vector<std::size_t> first_neighbour_;
  std::vector<Neighbour> neighbours_;  // of the examples, one after the other
  Views place_view_;                   // per class, the least over all rotations
  Views bond_view_;                    // per bond of the examples, the least over all rotations
};

LocalEnvironments::LocalEnvironments(const CalibrationInput& input, const Facets& facets,
                                     const BondStiffness& stiffness)
    : input_(input),
      size_(static_cast<std::size_t>(input.particles.size())),
      area_(size_, Offset{}),
      on_surface_(size_, 0),
      turns_(turns_of(*input.step)) {
  number_offsets();
  label_bonds(stiffness);
  measure_areas(facets);
}

void LocalEnvironments::number_offsets() {
  const Bonds& bonds = input_.bonds;
  const Vector3& step = *input_.step;
  std::unordered_map<Key, Index> numbers;
  offset_of_.reserve(bonds.lengths.size());
  for (Index k = 0; k < bonds.num_kinds(); ++k) {
    Offset offset{};
    for (int a = 0; a < 3; ++a) {
      offset[a] = std::llround(bonds.lengths[k] * bonds.direction_of_kind(k)[a] / step[a]);
    }
    const auto [entry, is_new] =
        numbers.try_emplace(join(0, offset), static_cast<Index>(offsets_.size()));
    if (is_new) {
      offsets_.push_back(offset);
      offsets_.push_back({-offset[0], -offset[1], -offset[2]});
    }
    offset_of_.push_back(entry->second);
  }
}

void LocalEnvironments::label_bonds(const BondStiffness& stiffness) {
  const Rounding axial(stiffness.axial), bending(stiffness.bending);
  const bool bends = !stiffness.bending.empty();
  label_.resize(stiffness.axial.size());
#pragma omp parallel for schedule(static)
  for (std::size_t b = 0; b < label_.size(); ++b) {
    label_[b] = join(0, Offset{input_.free[b], axial[b], bends ? bending[b] : 0});
  }
}

void LocalEnvironments::measure_areas(const Facets& facets) {
  std::vector<double> area(size_ * 3, 0.0);
  for (Index f = 0; f < facets.size(); ++f) {
    if (constants_across(facets, f, input_.materials) == LameConstants{}) continue;
    for (Index c = facets.corners.offsets[f]; c < facets.corners.offsets[f + 1]; ++c) {
      const Index i = facets.corners.values[c];
      on_surface_[i] = 1;
      for (int a = 0; a < 3; ++a) area[i * 3 + a] += facets.shares[c] * facets.area_vector(f)[a];
    }
  }
  const Rounding parts(area);
  for (std::size_t k = 0; k < area.size(); ++k) area_[k / 3][k % 3] = parts[k];
}

auto LocalEnvironments::first_views(std::span<const Index> particles, const Turn& turn) const
    -> Views {
  Views views;
  for (const Index i : particles) views.push_back(join(on_surface_[i], turn(area_[i])));
  return views;
}

auto LocalEnvironments::turned_offsets(const Turn& turn) const -> Views {
  Views views;
  for (const Offset& offset : offsets_) views.push_back(join(0, turn(offset)));
  return views;
}

/// Finds classes of particles that a translation maps on each other.
void LocalEnvironments::sort_places() {
  std::vector<Index> all(size_);
  std::iota(all.begin(), all.end(), 0);
  Views views = first_views(all, turns_.front());
  const Views offsets = turned_offsets(turns_.front());
  for (int round = 0; round < place_rounds; ++round) {
    Views sum(size_, 0);  // independent of the order of the bonds
    for (Index b = 0; b < input_.bonds.size(); ++b) {
      for (const bool reversed : {false, true}) {
        sum[start(b, reversed)] +=
            mix(offsets[offset(b, reversed)] + label_[b] + views[start(b, !reversed)]);
      }
    }
    for (std::size_t i = 0; i < size_; ++i) views[i] = join(views[i], sum[i]);
  }
  std::unordered_map<Key, Index> numbers;
  for (std::size_t i = 0; i < size_; ++i) {
    const auto [entry, is_new] = numbers.try_emplace(views[i], static_cast<Index>(numbers.size()));
    if (is_new) example_.push_back(static_cast<Index>(i));
    kind_.push_back(entry->second);
  }
}

void LocalEnvironments::find_neighbours() {
  const Index kinds = static_cast<Index>(example_.size());
  std::vector<Index> kind_of(size_, no_index);  // class of each example
  for (Index k = 0; k < kinds; ++k) kind_of[example_[k]] = k;
  const Csr ends = sorted_into_rows(kinds, [&](auto act) {  // twice the bond, plus one if reversed
    for (Index b = 0; b < input_.bonds.size(); ++b) {
      for (const bool reversed : {false, true}) {
        const Index kind = kind_of[start(b, reversed)];
        if (kind != no_index) act(kind, 2 * b + reversed);
      }
    }
  });
  first_neighbour_.assign(ends.offsets.begin(), ends.offsets.end());
  for (const Index end : ends.values) {
    const Index b = end / 2, reversed = end % 2;
    neighbours_.push_back({label_[b], offset(b, reversed != 0), kind_[start(b, !reversed)]});
  }
}

/// Returns the environment of a class, with the environments of its neighbours.
Key LocalEnvironments::look_around(std::size_t kind, const Views& views,
                                   const Views& offsets) const {
  Key sum = 0;
  for (std::size_t n = first_neighbour_[kind]; n < first_neighbour_[kind + 1]; ++n) {
    const Neighbour& other = neighbours_[n];
    sum += mix(offsets[other.offset] + other.label + views[other.kind]);
  }
  return join(views[kind], sum);
}

/// Finds classes and bonds that a rotation or reflection maps on each other; the least key over all
/// rotations identifies them. Only rotations with the least key of the near environment are
/// compared further.
void LocalEnvironments::turn_places() {
  const std::size_t kinds = example_.size();
  std::vector<Views> offsets(turns_.size()), near(turns_.size(), Views(kinds));
#pragma omp parallel for schedule(static)
  for (std::size_t t = 0; t < turns_.size(); ++t) {
    offsets[t] = turned_offsets(turns_[t]);
    const Views first = first_views(example_, turns_[t]);
    for (std::size_t k = 0; k < kinds; ++k) near[t][k] = look_around(k, first, offsets[t]);
  }
  place_view_.assign(kinds, ~Key{0});
  bond_view_.assign(neighbours_.size(), ~Key{0});
#pragma omp parallel for schedule(static)
  for (std::size_t k = 0; k < kinds; ++k) {
    Key nearest = ~Key{0};
    for (const Views& views : near) nearest = std::min(nearest, views[k]);
    for (std::size_t t = 0; t < turns_.size(); ++t) {
      if (near[t][k] != nearest) continue;
      place_view_[k] = std::min(place_view_[k], look_around(k, near[t], offsets[t]));
      for (std::size_t n = first_neighbour_[k]; n < first_neighbour_[k + 1]; ++n) {
        const Neighbour& other = neighbours_[n];
        const Key offset = offsets[t][other.offset];
        bond_view_[n] = std::min(
            bond_view_[n], join(nearest, offset + other.label) + mix(near[t][other.kind] + offset));
      }
    }
  }
}

BondOrbits LocalEnvironments::find(std::size_t most) {
  sort_places();
  if (example_.size() > most * turns_.size()) return {};
  find_neighbours();
  turn_places();
  std::unordered_map<Key, Index> numbers;
  std::vector<Index> number(example_.size() * offsets_.size());
  for (std::size_t k = 0; k < example_.size(); ++k) {
    for (std::size_t n = first_neighbour_[k]; n < first_neighbour_[k + 1]; ++n) {
      const auto next = static_cast<Index>(numbers.size());
      number[k * offsets_.size() + neighbours_[n].offset] =
          numbers.try_emplace(bond_view_[n], next).first->second;
    }
  }
  BondOrbits orbits;
  orbits.num_views = static_cast<Index>(numbers.size());
  orbits.views.assign(static_cast<std::size_t>(input_.bonds.size()), {no_index, no_index});
  std::vector<std::uint8_t> touched(size_, 0);
  for (Index b = 0; b < input_.bonds.size(); ++b) {
    if (!input_.free[b]) continue;
    orbits.views[b] = {number[seen(b, false)], number[seen(b, true)]};
    touched[start(b, false)] = touched[start(b, true)] = 1;
  }
  std::unordered_set<Key> known;
  for (std::size_t i = 0; i < size_; ++i) {
    if (touched[i] && known.insert(place_view_[kind_[i]]).second) {
      orbits.representatives.push_back(static_cast<Index>(i));
    }
  }
  return orbits;
}

/// Most equations of the symmetry-reduced problem. Their factor is nearly full.
constexpr std::size_t most_reduced_equations = 20000;
/// Least number of particles at free bonds per class of the reduced problem. A nearly full factor
/// of a third of the equations takes about as long as the unreduced problem (lattices with 2 800 to
/// 30 000 such particles: 2 to 4).
constexpr std::size_t least_reduction = 3;

bool uniform(const CalibrationInput& input) {
  const LameConstants& first = input.materials[input.particles.material.front()];
  return std::ranges::all_of(input.particles.material,
                             [&](Index m) { return input.materials[m] == first; });
}

}  // namespace

BondOrbits find_environments(const CalibrationInput& input, const Facets& facets,
                             const BondStiffness& stiffness, std::size_t most) {
  return LocalEnvironments(input, facets, stiffness).find(most);
}

std::optional<BondOrbits> equivalent_bonds(const CalibrationInput& input, const Facets& facets,
                                           const BondStiffness& stiffness) {
  if (input.all_free() || !(input.box || input.step) || !uniform(input)) return std::nullopt;
  const ForceRows rows{input.particles.dim, !stiffness.bending.empty()};
  const std::vector<std::uint8_t> ends = mark_ends(input.bonds, input.free, input.particles.size());
  const auto places = static_cast<std::size_t>(std::ranges::count(ends, 1));
  std::size_t most = most_reduced_equations / static_cast<std::size_t>(rows.count());
  if (!input.box) most = std::min(most, places / least_reduction);
  BondOrbits orbits = input.box ? find_orbits(*input.box, input.particles, input.bonds, input.free)
                                : find_environments(input, facets, stiffness, most);
  const std::size_t found = orbits.representatives.size();
  if (found == 0 || found > most) return std::nullopt;
  return orbits;
}

}  // namespace perilink
