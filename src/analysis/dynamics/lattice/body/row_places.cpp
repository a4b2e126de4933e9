#include "analysis/dynamics/lattice/body/row_places.hpp"

#include <algorithm>

namespace perilink {
namespace {

/// Slots before and after the first slot of a row to which bonds of its neighbours lead.
struct Margins {
  Index before = 0, after = 0;

  void cover(Index from, Index to) {
    before = std::max(before, -from);
    after = std::max(after, to);
  }
};

/// Calls visit(row, bond, other row, shift from the row to the other one) both ways along bonds.
template <class Visit>
void for_each_neighbour(const LatticeRows& lattice, const Visit& visit) {
  const Index own = lattice.own_bonds();
  for (Index r = 0; r < static_cast<Index>(lattice.rows.size()); ++r) {
    for (Index at = r * own; at < (r + 1) * own; ++at) {
      visit(r, at, lattice.row_out[at], lattice.shift_out[at], true);
      visit(r, at, lattice.row_in[at], -lattice.shift_in[at], false);
    }
  }
}

/// Returns the slot of row `other` to which the first slot of row `r` is shifted, counted from the
/// first slot of `other`.
Index landing(const LatticeRows& lattice, Index r, Index other, Index shift) {
  return lattice.rows[r].first + shift - lattice.rows[other].first;
}

Margins margins_of(const LatticeRows& lattice) {
  Margins margins;
  for (const LatticeRow& row : lattice.rows) margins.cover(0, row.size);
  for_each_neighbour(lattice, [&](Index r, Index, Index other, Index shift, bool) {
    if (other == no_index) return;
    const Index from = landing(lattice, r, other, shift);
    margins.cover(from, from + lattice.rows[r].size);
  });
  return margins;
}

/// Returns the position of each row: its own near edges, else one of the block's `alive`.
std::vector<Index> number_places(Index rows, const PassingRows& passing, Index& count) {
  std::vector<Index> place(rows);
  count = 0;
  for (Index b = 0; b < passing.blocks; ++b) {
    const Index begin = rows * b / passing.blocks, end = rows * (b + 1) / passing.blocks;
    const Index lower = b == 0 ? begin : std::min(end, begin + passing.edge);
    const Index upper = b == passing.blocks - 1 ? end : std::max(lower, end - passing.edge);
    for (Index r = begin; r < lower; ++r) place[r] = count++;
    for (Index r = lower; r < upper; ++r) place[r] = count + (r - lower) % passing.alive;
    count += std::min(passing.alive, upper - lower);
    for (Index r = upper; r < end; ++r) place[r] = count++;
  }
  return place;
}

/// Returns the distance between the parts of an array. Equal addresses modulo the page size would
/// evict each other from the cache.
Index padded(Index slots) {
  constexpr Index page = 512, apart = 40;  // numbers
  return slots + (page + apart - slots % page) % page;
}

}  // namespace

RowPlaces lattice_places(const LatticeRows& lattice) {
  RowPlaces places;
  places.slots = lattice.slots;
  for (const LatticeRow& row : lattice.rows) places.first.push_back(row.first);
  places.shift_out = lattice.shift_out;
  places.shift_in = lattice.shift_in;
  places.stale.assign(lattice.rows.size(), 0);
  return places;
}

RowPlaces passing_places(const LatticeRows& lattice, const PassingRows& passing) {
  const auto rows = static_cast<Index>(lattice.rows.size());
  const Margins margins = margins_of(lattice);
  Index count = 0;
  const std::vector<Index> place = number_places(rows, passing, count);
  // The last position stays empty, for bonds to rows without particles.
  const Index width = margins.before + margins.after, nowhere = count * width;
  RowPlaces places;
  places.slots = padded(nowhere + width);
  std::vector<Index> longest(count, 0);
  for (Index r = 0; r < rows; ++r) {
    places.first.push_back(place[r] * width + margins.before);
    longest[place[r]] = std::max(longest[place[r]], lattice.rows[r].size);
  }
  for (Index r = 0; r < rows; ++r) {
    places.stale.push_back(longest[place[r]] - lattice.rows[r].size);
  }
  places.shift_out.resize(lattice.shift_out.size());
  places.shift_in.resize(lattice.shift_in.size());
  for_each_neighbour(lattice, [&](Index r, Index at, Index other, Index shift, bool out) {
    const Index to =
        other == no_index ? nowhere : places.first[other] + landing(lattice, r, other, shift);
    (out ? places.shift_out[at] : places.shift_in[at]) =
        out ? to - places.first[r] : places.first[r] - to;
  });
  return places;
}

}  // namespace perilink
