#include "analysis/dynamics/lattice/body/row_places.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "support/lattice_models.hpp"

namespace perilink {
namespace {

using namespace testing_support;

/// Rows of very different lengths, with holes: a ring in the plane, a shell in space.
LatticeRows ring(int dim) {
  const double outer = dim == 2 ? 0.3 : 0.08;
  LatticeCut cut = rectangle(outer, outer, 0.01, 17.0);
  cut.lower[2] = -outer;
  cut.upper[2] = outer;
  cut.inside = [outer](const Vector3& x) {
    const double distance = std::hypot(x[0], x[1], x[2]);
    return 0.4 * outer < distance && distance < outer;
  };
  return dim == 2 ? hexagonal_rows(cut) : face_centred_rows(cut);
}

class PassingPlaces : public testing::TestWithParam<int> {
 protected:
  LatticeRows lattice = ring(GetParam());
  Index rows = static_cast<Index>(lattice.rows.size());
  PassingRows passing(Index blocks) const { return {blocks, 4 * lattice.reach, 2 * lattice.reach}; }

  /// Rows whose places hold this slot.
  std::vector<Index> users(const RowPlaces& places, Index slot) const {
    std::vector<Index> found;
    for (Index r = 0; r < rows; ++r) {
      if (slot >= places.first[r] && slot < places.first[r] + lattice.rows[r].size) {
        found.push_back(r);
      }
    }
    return found;
  }

  /// A shift from slot i of a row, in the lattice and among the places.
  void expect_same_end(const RowPlaces& places, Index r, Index other, Index i, Index shift,
                       Index shift_there) const {
    const Index to = places.first[r] + i + shift_there;
    ASSERT_GE(to, 0);
    ASSERT_LT(to, places.slots);
    const Index size = other == no_index ? 0 : lattice.rows[other].size;
    const Index wanted =
        other == no_index ? -1 : lattice.rows[r].first + i + shift - lattice.rows[other].first;
    if (0 <= wanted && wanted < size) {
      EXPECT_EQ(to - places.first[other], wanted);
      return;
    }
    // No bond leads there: the values must stay zero, or the other row must clear them.
    if (users(places, to).empty()) return;
    ASSERT_NE(other, no_index);
    EXPECT_GE(wanted, size);
    EXPECT_LT(wanted, size + places.stale[other]);
  }
};

TEST_P(PassingPlaces, BondsLeadToTheSameParticlesAndElseToZeros) {
  for (const Index blocks : {1, 2, 3}) {
    const RowPlaces places = passing_places(lattice, passing(blocks));
    for (Index r = 0; r < rows; ++r) {
      for (Index k = 0; k < lattice.own_bonds(); ++k) {
        const Index at = r * lattice.own_bonds() + k;
        for (const Index i : {Index{0}, lattice.rows[r].size / 2, lattice.rows[r].size - 1}) {
          expect_same_end(places, r, lattice.row_out[at], i, lattice.shift_out[at],
                          places.shift_out[at]);
          expect_same_end(places, r, lattice.row_in[at], i, -lattice.shift_in[at],
                          -places.shift_in[at]);
        }
      }
    }
  }
}

TEST_P(PassingPlaces, RowsThatAreNeededTogetherLieApart) {
  for (const Index blocks : {1, 2, 3}) {
    const PassingRows asked = passing(blocks);
    const RowPlaces places = passing_places(lattice, asked);
    const auto sharers = [&](Index r) { return users(places, places.first[r]); };
    for (Index b = 0; b < blocks; ++b) {
      const Index begin = rows * b / blocks, end = rows * (b + 1) / blocks;
      for (Index r = begin; r < end; ++r) {
        const bool kept =
            (b > 0 && r < begin + asked.edge) || (b + 1 < blocks && r >= end - asked.edge);
        for (const Index other : sharers(r)) {
          if (other == r) continue;
          EXPECT_FALSE(kept) << r << ' ' << other;
          EXPECT_GE(std::abs(other - r), asked.alive);
          EXPECT_TRUE(begin <= other && other < end) << "another thread's";
        }
      }
    }
  }
}

TEST_P(PassingPlaces, TakeFewSlots) {
  const RowPlaces places = passing_places(lattice, {1, 3 * lattice.reach, 0});
  EXPECT_LT(places.slots, GetParam() == 2 ? lattice.slots / 3 : lattice.slots);
  const RowPlaces whole = lattice_places(lattice);
  EXPECT_EQ(whole.slots, lattice.slots);
  EXPECT_EQ(whole.shift_in, lattice.shift_in);
}

INSTANTIATE_TEST_SUITE_P(RowPlaces, PassingPlaces, testing::Values(2, 3));

}  // namespace
}  // namespace perilink
