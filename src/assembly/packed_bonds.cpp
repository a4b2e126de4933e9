#include "assembly/packed_bonds.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace perilink {
namespace {

using Lanes [[gnu::vector_size(4 * block_width)]] = float;
using LanesInMemory [[gnu::vector_size(4 * block_width), gnu::aligned(4), gnu::may_alias]] = float;

template <int Dim>
const LanesInMemory* at(const float* numbers, std::size_t place) {
  return reinterpret_cast<const LanesInMemory*>(numbers + place * Dim * block_width);
}
template <int Dim>
LanesInMemory* at(float* numbers, std::size_t place) {
  return reinterpret_cast<LanesInMemory*>(numbers + place * Dim * block_width);
}

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

/// Calls visit(row, other) for the rows that an element is in, and the place of its end there.
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

/// Bonds between the same two particles are told by what they pull.
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
    throw std::logic_error("a bond is not where it was packed");
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

template <int Dim>
void PackedBonds::add_forces(std::size_t part, const float* motions, float* forces,
                             const PlacesDone& done) const {
  constexpr std::size_t together = 64;
  const std::size_t end = part_end_[part];
  std::size_t told = part == 0 ? 0 : part_end_[part - 1];
  const std::ptrdiff_t row = Dim * block_width;
  std::fill(forces + told * row, forces + end * row, 0.0F);
  const Packed<Dim>* bond = bonds<Dim>().data() + begin_[2 * told];
  for (std::size_t place = told; place < end; ++place) {
    const LanesInMemory* own_motion = at<Dim>(motions, place);
    LanesInMemory* own_force = at<Dim>(forces, place);
    Lanes motion[Dim], force[Dim];
    for (int a = 0; a < Dim; ++a) {
      motion[a] = own_motion[a];
      force[a] = own_force[a];
    }
    const auto tension_of = [&](const Packed<Dim>& own) {
      const LanesInMemory* other_motion = at<Dim>(motions, own.other);
      Lanes tension = own.pull[0] * (other_motion[0] - motion[0]);
      for (int a = 1; a < Dim; ++a) tension += own.pull[a] * (other_motion[a] - motion[a]);
      return tension;
    };
    for (const auto* behind = bonds<Dim>().data() + begin_[2 * place + 1]; bond < behind; ++bond) {
      LanesInMemory* other_force = at<Dim>(forces, bond->other);
      const Lanes tension = tension_of(*bond);
      for (int a = 0; a < Dim; ++a) {
        const Lanes pull = bond->pull[a] * tension;
        force[a] -= pull;
        other_force[a] += pull;
      }
    }
    for (const auto* last = bonds<Dim>().data() + begin_[2 * place + 2]; bond < last; ++bond) {
      const Lanes tension = tension_of(*bond);
      for (int a = 0; a < Dim; ++a) force[a] -= bond->pull[a] * tension;
    }
    for (int a = 0; a < Dim; ++a) own_force[a] = force[a];
    // Bonds behind end at places behind, or add nothing to the other end.
    if (place + 1 < told + together && place + 1 < end) continue;
    done(part, told, place + 1);
    told = place + 1;
  }
}

void PackedBonds::forces(std::span<const float> motions, std::span<float> forces,
                         const PlacesDone& done) const {
#pragma omp parallel for schedule(dynamic) if (part_end_.size() > 1)
  for (std::size_t part = 0; part < part_end_.size(); ++part) {
    network_.dim() == 2 ? add_forces<2>(part, motions.data(), forces.data(), done)
                        : add_forces<3>(part, motions.data(), forces.data(), done);
  }
}

}  // namespace perilink
