#pragma once

#include <array>
#include <functional>
#include <span>
#include <vector>

#include "base/types.hpp"

namespace perilink {

/// A bond of every particle of a lattice to one of its neighbours. Each particle owns half of its
/// bonds; the other half are its neighbours' own.
struct OwnBond {
  std::array<int, 3> step{};  ///< to the neighbour, in lattice vectors
  Vector3 direction{};        ///< unit vector
  double length = 0.0;        ///< [length]
};

/// Slots first, ..., first + size - 1 hold a row of particles, with gaps where the body has some
/// and empty slots at the end up to a whole number of vectors.
struct LatticeRow {
  Index first = 0;
  Index size = 0;
};

/// Particles of a lattice, stored row after row so that within a row the partner of own bond k of
/// slot s is slot s + shift: loops over a row read nothing but neighbouring memory. Around each row
/// lie empty slots, so that every shift from a row leads to a slot; particles and bonds that do not
/// exist are zeros of masks, never branches.
struct LatticeRows {
  int dim = 2;
  double spacing = 0.0;        ///< to nearest neighbours [length]
  double cell_volume = 0.0;    ///< volume of an interior particle [length^3]
  std::vector<OwnBond> bonds;  ///< three (hexagonal) or nine (face-centred cubic)
  std::vector<LatticeRow> rows;
  std::vector<Index> shift_out;  ///< slot of own bond k's partner, shape (rows, own bonds)
  std::vector<Index> shift_in;   ///< minus slot whose own bond k ends here, shape (rows, own bonds)
  std::vector<Index> row_out;    ///< row of own bond k's partners or no_index: the row itself or
                                 ///< one after it, same shape
  std::vector<Index> row_in;     ///< row whose own bonds k end here or no_index, same shape
  Index reach = 0;               ///< largest difference between a row and a row_out of it
  Index slots = 0;
  std::vector<double> positions;     ///< [length], shape (dim, slots)
  std::vector<double> present;       ///< one where the own bond exists, shape (own bonds, slots)
  std::vector<Index> bond_count;     ///< bonds of either owner at a slot
  std::vector<Index> particle_slot;  ///< slot of each particle, ascending

  int own_bonds() const { return static_cast<int>(bonds.size()); }
  Index particles() const { return static_cast<Index>(particle_slot.size()); }
  Index at(int k, Index slot) const { return k * slots + slot; }
};

/// Calls visit(row, slot) for every particle, in their order.
template <class Visit>
void for_each_particle(const LatticeRows& lattice, const Visit& visit) {
  Index row = 0;
  for (const Index slot : lattice.particle_slot) {
    while (slot >= lattice.rows[row].first + lattice.rows[row].size) ++row;
    visit(row, slot);
  }
}

/// How a lattice lies and what is cut from it.
struct LatticeCut {
  double spacing = 0.0;
  double rotation = 0.0;     ///< angle between rows and x axis, about z [rad]
  Vector3 origin{};          ///< a lattice point
  double thickness = 1.0;    ///< two-dimensional bodies only [length]
  Vector3 lower{}, upper{};  ///< box around the body
  /// Whether a lattice point belongs to the body; asked for points of the box only.
  std::function<bool(const Vector3&)> inside;
};

/// Six neighbours in the plane.
/// \throws std::invalid_argument where no lattice point lies in the body
LatticeRows hexagonal_rows(const LatticeCut& cut);

/// Eighteen neighbours in space: twelve nearest and six second.
/// \throws std::invalid_argument as above
LatticeRows face_centred_rows(const LatticeCut& cut);

}  // namespace perilink
