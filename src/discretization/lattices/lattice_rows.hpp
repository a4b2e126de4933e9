#pragma once

#include <array>
#include <functional>
#include <span>
#include <vector>

#include "base/types.hpp"

namespace perilink {

/// Stored half of the bonds: a direction in which every particle stores one bond. The opposite
/// bonds are stored at the neighbours.
struct OwnBond {
  std::array<int, 3> step{};  ///< to the neighbour, in lattice vectors
  Vector3 direction{};        ///< unit vector
  double length = 0.0;        ///< [length]
};

/// Row of particles in the slots first, ..., first + size - 1. The row may have gaps and ends with
/// empty slots up to a whole number of vectors.
struct LatticeRow {
  Index first = 0;
  Index size = 0;
};

/// Particles of a lattice, stored row after row. Within a row the partner of own bond k of slot s
/// is slot s + shift. Loops over a row therefore read contiguous memory. Empty slots surround each
/// row, so that every shift ends at a slot. Missing particles and bonds are zeros of masks, without
/// branches.
struct LatticeRows {
  int dim = 2;
  double spacing = 0.0;        ///< to nearest neighbours [length]
  double cell_volume = 0.0;    ///< volume of an interior particle [length^3]
  std::vector<OwnBond> bonds;  ///< three (hexagonal) or nine (face-centred cubic)
  std::vector<LatticeRow> rows;
  std::vector<Index> shift_out;  ///< from a slot to own bond k's partner, shape (rows, own bonds)
  std::vector<Index>
      shift_in;                ///< from the owner of bond k that ends here, shape (rows, own bonds)
  std::vector<Index> row_out;  ///< row of own bond k's partners or no_index: the row itself or a
                               ///< later one, same shape
  std::vector<Index> row_in;   ///< row with own bonds k that end here, or no_index, same shape
  Index reach = 0;             ///< largest difference between a row and its row_out
  Index slots = 0;
  std::vector<double> positions;     ///< [length], shape (dim, slots)
  std::vector<double> present;       ///< one where the own bond exists, shape (own bonds, slots)
  std::vector<Index> bond_count;     ///< bonds of each slot, stored there or at a neighbour
  std::vector<Index> particle_slot;  ///< slot of each particle, ascending

  int own_bonds() const { return static_cast<int>(bonds.size()); }
  Index particles() const { return static_cast<Index>(particle_slot.size()); }
  Index at(int k, Index slot) const { return k * slots + slot; }
};

/// Calls visit(row, slot) for every particle in order.
template <class Visit>
void for_each_particle(const LatticeRows& lattice, const Visit& visit) {
  Index row = 0;
  for (const Index slot : lattice.particle_slot) {
    while (slot >= lattice.rows[row].first + lattice.rows[row].size) ++row;
    visit(row, slot);
  }
}

/// Position of a lattice and the body cut from it.
struct LatticeCut {
  double spacing = 0.0;
  double rotation = 0.0;     ///< angle between rows and x axis, about z [rad]
  Vector3 origin{};          ///< a lattice point
  double thickness = 1.0;    ///< two-dimensional bodies only [length]
  Vector3 lower{}, upper{};  ///< box around the body
  /// Whether a lattice point belongs to the body; only called for points of the box.
  std::function<bool(const Vector3&)> inside;
};

/// Returns rows of a hexagonal lattice: six neighbours in the plane.
/// \throws std::invalid_argument if no lattice point lies in the body
LatticeRows hexagonal_rows(const LatticeCut& cut);

/// Returns rows of a face-centred lattice: twelve nearest and six second neighbours in space.
/// \throws std::invalid_argument if no lattice point lies in the body
LatticeRows face_centred_rows(const LatticeCut& cut);

}  // namespace perilink
