#include "assembly/packed_bonds.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "base/lanes.hpp"

namespace perilink {
namespace {

/// Components of a particle in as many vectors of a block as fit one register. More would exceed
/// the few registers.
template <int Dim>
struct RowOfBlock {
  using Number = float;
  static constexpr std::size_t lanes = lanes_of<float>(block_width);
  using Floats = Lanes<float, lanes>;
  using InMemory = LanesInMemory<float, lanes>;
  static constexpr std::size_t size = static_cast<std::size_t>(Dim) * block_width;
  static constexpr std::size_t vectors = block_width;

  explicit RowOfBlock(const float* numbers) {
    for (int a = 0; a < Dim; ++a) {
      parts[a] = *reinterpret_cast<const InMemory*>(numbers + a * block_width);
    }
  }
  void store(float* numbers) const {
    for (int a = 0; a < Dim; ++a) {
      *reinterpret_cast<InMemory*>(numbers + a * block_width) = parts[a];
    }
  }
  struct Pull {
    explicit Pull(const float* numbers) : parts(numbers) {}
    const float* parts;
  };
  static Floats tension(Pull pull, const RowOfBlock& own, const RowOfBlock& other) {
    Floats sum = pull.parts[0] * (own.parts[0] - other.parts[0]);
    for (int a = 1; a < Dim; ++a) sum += pull.parts[a] * (own.parts[a] - other.parts[a]);
    return sum;
  }
  void add(Pull pull, Floats tension) {
    for (int a = 0; a < Dim; ++a) parts[a] += pull.parts[a] * tension;
  }

  Floats parts[Dim];
};

/// Components of a particle in one vector, in space padded with a zero.
template <int Dim>
struct RowOfVector {
  using Number = double;
  static constexpr std::size_t size = PackedBonds::row_size(Dim);
  static constexpr std::size_t lanes = 1, vectors = 1;
  using Components = Lanes<double, size>;
  using InMemory = LanesInMemory<double, size>;

  explicit RowOfVector(const double* numbers)
      : parts(*reinterpret_cast<const InMemory*>(numbers)) {}
  void store(double* numbers) const { *reinterpret_cast<InMemory*>(numbers) = parts; }
  struct Pull {
    /// In space the load reads one number past the components.
    explicit Pull(const float* numbers) {
      if constexpr (Dim == 3) {
        parts = widen(numbers);
        parts[3] = 0.0;
      } else {
        const Lanes<float, 2> read = *reinterpret_cast<const LanesInMemory<float, 2>*>(numbers);
        parts = __builtin_convertvector(read, Components);
      }
    }
    Components parts;
  };
  static double tension(const Pull& pull, const RowOfVector& own, const RowOfVector& other) {
    const Components terms = pull.parts * (own.parts - other.parts);
    if constexpr (Dim == 2) return terms[0] + terms[1];
    if constexpr (Dim == 3) return add_up(terms);
  }
  void add(const Pull& pull, double tension) { parts += pull.parts * tension; }

  Components parts;
};

}  // namespace

template <int Dim>
auto& PackedBonds::bonds() {
  if constexpr (Dim == 2) return plane_;
  if constexpr (Dim == 3) return space_;
}

template <int Dim>
const auto& PackedBonds::bonds() const {
  if constexpr (Dim == 2) return plane_;
  if constexpr (Dim == 3) return space_;
}

PackedBonds::PackedBonds(const Network& network, Secants secants, std::span<const Index> place,
                         double unit, std::span<const std::size_t> part_end)
    : network_(network),
      place_(place.begin(), place.end()),
      unit_(unit),
      part_end_(part_end.begin(), part_end.end()),
      begin_(2 * place.size() + 2, 0) {
  network.dim() == 2 ? fill<2>(secants) : fill<3>(secants);
}

/// Calls visit(row, other) for every row that contains an element, with the place of its other end.
template <class Visit>
void PackedBonds::for_each_row(Index element, Visit visit) const {
  const auto [from, to] =
      std::minmax(place_[network_.bonds.first[element]], place_[network_.bonds.second[element]]);
  const auto part_of = [&](Index place) {
    return std::ranges::upper_bound(part_end_, static_cast<std::size_t>(place));
  };
  const std::size_t row = 2 * static_cast<std::size_t>(from);
  if (part_of(from) == part_of(to)) return visit(row, to);
  visit(row + 1, to);
  visit(2 * static_cast<std::size_t>(to) + 1, from);
}

template <int Dim>
auto PackedBonds::packed(Index element, double secant) const -> Packed<Dim> {
  Packed<Dim> bond{};
  const double root = std::sqrt(network_.stiffness[element] * secant / unit_);
  const auto n = network_.bonds.direction(element);
  for (int c = 0; c < Dim; ++c) bond.pull[c] = static_cast<float>(n[c] * root);
  return bond;
}

template <int Dim>
void PackedBonds::fill(Secants secants) {
  const Index count = network_.num_elements();
  for (Index e = 0; e < count; ++e) {
    for_each_row(e, [&](std::size_t row, Index) { ++begin_[row + 2]; });
  }
  for (std::size_t k = 2; k < begin_.size(); ++k) begin_[k] += begin_[k - 1];
  bonds<Dim>().resize(begin_.back());
  for (Index e = 0; e < count; ++e) {
    const double secant = secants.axial(e);
    if (secant != 1.0) damaged_[e] = secant;
    Packed<Dim> bond = packed<Dim>(e, secant);
    for_each_row(e, [&](std::size_t row, Index other) {
      bond.other = other;
      bonds<Dim>()[begin_[row + 1]++] = bond;
    });
  }
  begin_.pop_back();
}

/// Bonds between the same two particles are distinguished by their pull.
template <int Dim>
void PackedBonds::set(Index element, double before, double now) {
  const Packed<Dim> old = packed<Dim>(element, before), next = packed<Dim>(element, now);
  for_each_row(element, [&](std::size_t row, Index other) {
    for (std::size_t k = begin_[row]; k < begin_[row + 1]; ++k) {
      Packed<Dim>& bond = bonds<Dim>()[k];
      if (bond.other != other || !std::ranges::equal(bond.pull, old.pull)) continue;
      std::ranges::copy(next.pull, bond.pull);
      return;
    }
    throw std::logic_error("a packed bond was not found");
  });
}

void PackedBonds::set_any(Index element, double before, double now) {
  network_.dim() == 2 ? set<2>(element, before, now) : set<3>(element, before, now);
}

void PackedBonds::follow(Secants secants) {
  for (auto k = damaged_.begin(); k != damaged_.end();) {
    const double now = secants.axial(k->first);
    if (now != k->second) set_any(k->first, k->second, now);
    k->second = now;
    k = now == 1.0 ? damaged_.erase(k) : std::next(k);
  }
  for (Index e = 0; e < network_.num_elements(); ++e) {
    const double now = secants.axial(e);
    if (now == 1.0 || !damaged_.try_emplace(e, now).second) continue;
    set_any(e, 1.0, now);
  }
}

/// Computes the forces of the bonds at a place.
template <int Dim, class Row>
void PackedBonds::region_forces(std::size_t place, const typename Row::Number* motions,
                                typename Row::Number* forces) const {
  using Pull = typename Row::Pull;
  constexpr std::size_t ahead = 128;  // the processor's own prefetching is too late
  const Row motion(motions + place * Row::size);
  Row force(forces + place * Row::size);
  const auto tension_of = [&](const Packed<Dim>& own, const Pull& pull) {
    const Row other(motions + static_cast<std::size_t>(own.other) * Row::size);
    return Row::tension(pull, motion, other);
  };
  const Packed<Dim>* const all = bonds<Dim>().data();
  const Packed<Dim>* bond = all + begin_[2 * place];
  for (const auto* behind = all + begin_[2 * place + 1]; bond < behind; ++bond) {
    typename Row::Number* at = forces + static_cast<std::size_t>(bond->other) * Row::size;
    __builtin_prefetch(bond + ahead);
    const Pull pull(bond->pull);
    const auto tension = tension_of(*bond, pull);
    force.add(pull, tension);
    Row other(at);
    other.add(pull, -tension);
    other.store(at);
  }
  for (const auto* last = all + begin_[2 * place + 2]; bond < last; ++bond) {
    const Pull pull(bond->pull);
    force.add(pull, tension_of(*bond, pull));
  }
  force.store(forces + place * Row::size);
}

/// \param done  callback, see PlacesDone
template <int Dim, class Row, class Done>
void PackedBonds::part_forces(std::size_t part, const typename Row::Number* motions,
                              typename Row::Number* forces, const Done& done) const {
  constexpr std::size_t together = 64;
  const std::size_t end = part_end_[part];
  std::size_t told = part == 0 ? 0 : part_end_[part - 1];
  std::fill(forces + told * Row::size, forces + end * Row::size, typename Row::Number{});
  for (std::size_t place = told; place < end; ++place) {
    for (std::size_t from = 0; from < Row::vectors; from += Row::lanes) {
      region_forces<Dim, Row>(place, motions + from, forces + from);
    }
    // Later bonds end at later places or add nothing to their other end, so earlier places are
    // complete.
    if (place + 1 < told + together && place + 1 < end) continue;
    done(part, told, place + 1);
    told = place + 1;
  }
}

template <template <int> class Row, class Number, class Done>
void PackedBonds::all_forces(const Number* motions, Number* forces, const Done& done) const {
#pragma omp parallel for schedule(dynamic) if (part_end_.size() > 1)
  for (std::size_t part = 0; part < part_end_.size(); ++part) {
    network_.dim() == 2 ? part_forces<2, Row<2>>(part, motions, forces, done)
                        : part_forces<3, Row<3>>(part, motions, forces, done);
  }
}

void PackedBonds::forces(std::span<const float> motions, std::span<float> forces,
                         const PlacesDone& done) const {
  all_forces<RowOfBlock>(motions.data(), forces.data(), done);
}

void PackedBonds::forces(std::span<const double> motion, std::span<double> forces) const {
  all_forces<RowOfVector>(motion.data(), forces.data(),
                          [](std::size_t, std::size_t, std::size_t) {});
}

}  // namespace perilink
