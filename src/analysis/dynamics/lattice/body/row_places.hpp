#pragma once

#include <vector>

#include "discretization/lattices/lattice_rows.hpp"

namespace perilink {

/// Where the rows of a lattice lie in arrays that hold numbers of bonds or particles for a part of
/// a step only. Within a row slots follow one another as everywhere else.
struct RowPlaces {
  Index slots = 0;               ///< number of slots in one part of an array
  std::vector<Index> first;      ///< slot of each row's first particle
  std::vector<Index> shift_out;  ///< to own bond k's partner, shape (rows, own bonds)
  std::vector<Index> shift_in;   ///< minus slot whose own bond k ends here, same shape
  std::vector<Index> stale;      ///< slots after each row that rows before it may have left behind

  Index at(int part, Index slot) const { return part * slots + slot; }
};

/// Every row at the slots that it has in the lattice.
RowPlaces lattice_places(const LatticeRows& lattice);

/// How the rows of a sweep follow one another.
struct PassingRows {
  Index blocks = 1;  ///< blocks of rows, as equal as can be
  Index alive = 1;   ///< rows of a block whose numbers are needed at the same time
  Index edge = 0;  ///< rows on either side of an edge between blocks that keep their numbers until
                   ///< all blocks are done
};

/// Rows that take the places of rows which a sweep is done with, so that the numbers of a step stay
/// in the cache; rows near edges of blocks have places of their own.
RowPlaces passing_places(const LatticeRows& lattice, const PassingRows& passing);

}  // namespace perilink
