#pragma once

#include <vector>

#include "discretization/lattices/lattice_rows.hpp"

namespace perilink {

/// Positions of lattice rows in arrays whose values are needed during a part of a step only. Within
/// a row the slots are consecutive.
struct RowPlaces {
  Index slots = 0;               ///< number of slots in one part of an array
  std::vector<Index> first;      ///< slot of each row's first particle
  std::vector<Index> shift_out;  ///< to own bond k's partner, shape (rows, own bonds)
  std::vector<Index> shift_in;   ///< minus slot whose own bond k ends here, same shape
  std::vector<Index> stale;      ///< slots after each row that may hold values of earlier rows

  Index at(int part, Index slot) const { return part * slots + slot; }
};

/// Returns positions equal to the slots of the lattice.
RowPlaces lattice_places(const LatticeRows& lattice);

/// Order of rows in a sweep.
struct PassingRows {
  Index blocks = 1;  ///< blocks of rows of nearly equal size
  Index alive = 1;   ///< rows of a block whose values are needed at one time
  /// rows on either side of an edge between blocks that keep their values until all blocks are
  /// done
  Index edge = 0;
};

/// Returns positions in cache-blocked sweep buffers: rows reuse positions of finished rows, so that
/// the values of a step stay in the cache. Rows near edges of blocks have their own positions.
RowPlaces passing_places(const LatticeRows& lattice, const PassingRows& passing);

}  // namespace perilink
