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
                         double unit)
    : network_(network),
      place_(place.begin(), place.end()),
      unit_(unit),
      begin_(place.size() + 2, 0) {
  network.dim() == 2 ? fill<2>(secants) : fill<3>(secants);
}

template <int Dim>
auto PackedBonds::packed(Index element, double secant) const -> Packed<Dim> {
  const Index a = place_[network_.bonds.first[element]];
  const Index b = place_[network_.bonds.second[element]];
  Packed<Dim> bond{std::max(a, b), {}};
  const double root = std::sqrt(network_.stiffness[element] * secant / unit_);
  const auto n = network_.bonds.direction(element);
  for (int c = 0; c < Dim; ++c) bond.pull[c] = static_cast<float>(n[c] * root);
  return bond;
}

template <int Dim>
void PackedBonds::fill(Secants secants) {
  const auto from = [&](Index e) {
    return std::min(place_[network_.bonds.first[e]], place_[network_.bonds.second[e]]);
  };
  const Index count = network_.num_elements();
  for (Index e = 0; e < count; ++e) ++begin_[from(e) + 2];
  for (std::size_t k = 2; k < begin_.size(); ++k) begin_[k] += begin_[k - 1];
  bonds<Dim>().resize(static_cast<std::size_t>(count));
  for (Index e = 0; e < count; ++e) {
    const double secant = secants.axial(e);
    if (secant != 1.0) damaged_[e] = secant;
    bonds<Dim>()[begin_[from(e) + 1]++] = packed<Dim>(e, secant);
  }
  begin_.pop_back();
}

/// Bonds between the same two particles are told by what they pull.
template <int Dim>
void PackedBonds::set(Index element, double before, double now) {
  const Packed<Dim> old = packed<Dim>(element, before);
  const Index from =
      std::min(place_[network_.bonds.first[element]], place_[network_.bonds.second[element]]);
  for (std::size_t k = begin_[from]; k < begin_[from + 1]; ++k) {
    Packed<Dim>& bond = bonds<Dim>()[k];
    if (bond.other != old.other || !std::ranges::equal(bond.pull, old.pull)) continue;
    bond = packed<Dim>(element, now);
    return;
  }
  throw std::logic_error("a bond is not where it was packed");
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
void PackedBonds::add_forces(const float* motions, float* forces, const PlacesDone& done) const {
  constexpr std::size_t together = 64;
  const Packed<Dim>* bond = bonds<Dim>().data();
  std::size_t told = 0;
  for (std::size_t place = 0; place + 1 < begin_.size(); ++place) {
    const LanesInMemory* own_motion = at<Dim>(motions, place);
    LanesInMemory* own_force = at<Dim>(forces, place);
    Lanes motion[Dim], force[Dim];
    for (int a = 0; a < Dim; ++a) {
      motion[a] = own_motion[a];
      force[a] = own_force[a];
    }
    for (const Packed<Dim>* end = bonds<Dim>().data() + begin_[place + 1]; bond < end; ++bond) {
      const LanesInMemory* other_motion = at<Dim>(motions, bond->other);
      LanesInMemory* other_force = at<Dim>(forces, bond->other);
      Lanes tension = bond->pull[0] * (other_motion[0] - motion[0]);
      for (int a = 1; a < Dim; ++a) tension += bond->pull[a] * (other_motion[a] - motion[a]);
      for (int a = 0; a < Dim; ++a) {
        const Lanes part = bond->pull[a] * tension;
        force[a] -= part;
        other_force[a] += part;
      }
    }
    for (int a = 0; a < Dim; ++a) own_force[a] = force[a];
    // Bonds behind end at places behind.
    if (place + 1 < told + together && place + 2 < begin_.size()) continue;
    done(told, place + 1);
    told = place + 1;
  }
}

void PackedBonds::forces(std::span<const float> motions, std::span<float> forces,
                         const PlacesDone& done) const {
  std::ranges::fill(forces, 0.0F);
  network_.dim() == 2 ? add_forces<2>(motions.data(), forces.data(), done)
                      : add_forces<3>(motions.data(), forces.data(), done);
}

}  // namespace perilink
