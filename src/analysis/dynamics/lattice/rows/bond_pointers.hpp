#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "analysis/dynamics/lattice/body/lattice_state.hpp"

namespace perilink {

/// Returns the factor of a bond for the sign of its stretch. Both factors are read, so that loops
/// need no branches.
inline double by_sign(double stretch, double in_tension, double in_compression) {
  return stretch >= 0.0 ? in_tension : in_compression;
}

/// n n' of the own bonds of a lattice in the plane.
struct PlaneProducts {
  double xx[3], yy[3], xy[3];

  explicit PlaneProducts(const LatticeRows& lattice) {
    for (int k = 0; k < 3; ++k) {
      const Vector3& n = lattice.bonds[k].direction;
      xx[k] = n[0] * n[0], yy[k] = n[1] * n[1], xy[k] = n[0] * n[1];
    }
  }
};

/// Fields of the bonds of a row's particles in loops over the row: own bonds first, then incoming
/// ones; null for empty fields.
template <int Bonds>
struct BondPointers {
  std::array<const double*, Bonds> effective, stretch, rate, present, tension, compression, half;
  std::array<const double*, Bonds> share_tension, share_compression;

  // Inlined, so that loops compute only pointers to fields that they read: rows may be short.
  [[gnu::always_inline]] BondPointers(const ExplicitModel& model, const ExplicitState& state,
                                      Index row) {
    const LatticeRows& lattice = model.lattice;
    constexpr int own = Bonds / 2;
    const auto fill_from = [&](auto& pointers, const std::vector<double>& field, Index first,
                               const std::vector<Index>& shift_in, Index slots) {
      for (int j = 0; j < Bonds; ++j) {
        const int k = j % own;
        const Index start = j < own ? first : first - shift_in[row * own + k];
        const std::size_t part = static_cast<std::size_t>(k) * slots;
        pointers[j] = field.empty() ? nullptr : field.data() + part + start;
      }
    };
    const auto fill_now = [&](auto& pointers, const std::vector<double>& field) {
      const RowPlaces& places = state.now.places;
      fill_from(pointers, field, places.first[row], places.shift_in, places.slots);
    };
    const auto fill = [&](auto& pointers, const std::vector<double>& field) {
      fill_from(pointers, field, lattice.rows[row].first, lattice.shift_in, lattice.slots);
    };
    fill_now(effective, state.now.effective);
    fill_now(stretch, state.now.stretch);
    fill(rate, state.rate);
    fill(present, lattice.present);
    fill(tension, state.in_tension);
    fill(compression, state.in_compression);
    fill(half, state.flow.half);
    fill(share_tension, state.share_tension);
    fill(share_compression, state.share_compression);
  }
};

}  // namespace perilink
