#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "analysis/dynamics/lattice/body/lattice_state.hpp"
#include "analysis/dynamics/lattice/rows/bond_pointers.hpp"

/// \file
/// Pointers to a row's part of a field, for loops over the row.

namespace perilink::row_loops {

/// Bonds in one loop: all three of a hexagonal lattice, a third of a face-centred one.
inline constexpr int group = 3;

/// Returns an array of a slot-shaped field from the first slot of a row; null for an empty field.
inline const double* at(const std::vector<double>& field, const LatticeRows& lattice, Index part,
                        const LatticeRow& row) {
  if (field.empty()) return nullptr;
  return field.data() + static_cast<std::size_t>(part) * lattice.slots + row.first;
}
inline double* at(std::vector<double>& field, const LatticeRows& lattice, Index part,
                  const LatticeRow& row) {
  if (field.empty()) return nullptr;
  return field.data() + static_cast<std::size_t>(part) * lattice.slots + row.first;
}

/// Returns an array of values of the present step from the first slot of a row; null for an empty
/// field.
template <class Field>
auto* at_now(Field& field, const RowPlaces& places, Index part, Index r) {
  return field.empty()
             ? nullptr
             : field.data() + static_cast<std::size_t>(part) * places.slots + places.first[r];
}

template <class Field, class Pointer>
void at_bonds_now(Field& field, const RowPlaces& places, int first, Index r,
                  std::array<Pointer, group>& pointers) {
  for (int g = 0; g < group; ++g) pointers[g] = at_now(field, places, first + g, r);
}

template <class Field, class Pointer>
void at_bonds(Field& field, const LatticeRows& lattice, int first, const LatticeRow& row,
              std::array<Pointer, group>& pointers) {
  for (int g = 0; g < group; ++g) pointers[g] = at(field, lattice, first + g, row);
}

/// Returns whether the stretches of a row's bonds have separate weights in the sums.
inline bool is_weighted(const ExplicitModel& model, const ExplicitState& state, Index row) {
  return model.weighs_halves() && (state.bond_changes[row] & BondChanges::weakened) != 0;
}

/// Weights of own bonds in the sums of their two ends (half_bond_weight).
struct WeightPointers {
  std::array<const double*, group> present, share_tension, share_compression;
  const double *root_tension, *root_compression;  ///< roots of the owner
  Index shift[group];                             ///< shift from the owner to the partner

  WeightPointers(const LatticeRows& lattice, const ExplicitState& state, Index r, int first) {
    const LatticeRow& row = lattice.rows[r];
    at_bonds(lattice.present, lattice, first, row, present);
    at_bonds(state.share_tension, lattice, first, row, share_tension);
    at_bonds(state.share_compression, lattice, first, row, share_compression);
    root_tension = at(state.root_tension, lattice, 0, row);
    root_compression = at(state.root_compression, lattice, 0, row);
    const Index* out = lattice.shift_out.data() + r * lattice.own_bonds() + first;
    for (int g = 0; g < group; ++g) shift[g] = out[g];
  }

  double of_owner(int g, Index i, double stretch) const {
    return present[g][i] * by_sign(stretch, share_tension[g][i], share_compression[g][i]) *
           by_sign(stretch, root_tension[i], root_compression[i]);
  }
  double of_partner(int g, Index i, double stretch) const {
    const double share = 2.0 - by_sign(stretch, share_tension[g][i], share_compression[g][i]);
    const Index other = i + shift[g];
    return present[g][i] * share * by_sign(stretch, root_tension[other], root_compression[other]);
  }
  /// Returns the weighted mean of both ends' contributions to the bond's force.
  double mean(int g, Index i, double stretch, double owner, double partner) const {
    return 0.5 * (of_owner(g, i, stretch) * owner + of_partner(g, i, stretch) * partner);
  }
};

}  // namespace perilink::row_loops
