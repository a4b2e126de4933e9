#include "analysis/dynamics/lattice/ranks/row_partition.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "analysis/dynamics/lattice/body/lattice_particles.hpp"
#include "support/lattice_models.hpp"

namespace perilink {
namespace {

using namespace testing_support;

/// In the plane; with a hole.
ExplicitModel plate() {
  return changing_body({Problem::plane_stress, LatticeRules::consistent, true, true});
}

/// Stages that need three rows before them and two after.
constexpr SweepReach reach{2, 3, 1};

TEST(RowPartition, SharesOutAllRowsAndTellsNeighboursOfTheSame) {
  const ExplicitModel model = plate();
  const auto rows = static_cast<Index>(model.lattice.rows.size());
  for (const int ranks : {1, 2, 3, 5}) {
    const RowPartition partition(model.lattice, reach, ranks);
    ASSERT_EQ(partition.count(), ranks);
    EXPECT_EQ(partition.own(0).begin, 0);
    EXPECT_EQ(partition.own(ranks - 1).end, rows);
    for (int rank = 0; rank < ranks; ++rank) {
      const RowPart part = partition.part(rank);
      const Index first = partition.known(rank).begin;
      EXPECT_EQ(part.own.begin + first, partition.own(rank).begin);
      EXPECT_EQ(part.own.end + first, partition.own(rank).end);
      // What its stages leave out at cuts leaves its own rows.
      EXPECT_EQ(part.swept.begin + (part.swept.cut_before ? reach.behind : 0), part.own.begin);
      EXPECT_EQ(part.swept.end - (part.swept.cut_after ? reach.ahead : 0), part.own.end);
      EXPECT_EQ(part.swept.cut_before, rank > 0);
      EXPECT_EQ(part.swept.cut_after, rank + 1 < ranks);
      if (rank == 0) continue;
      const RowPart before = partition.part(rank - 1);
      const Index shift = first - partition.known(rank - 1).begin;
      EXPECT_EQ(part.from_before.begin + shift, before.to_after.begin);
      EXPECT_EQ(part.from_before.end + shift, before.to_after.end);
      EXPECT_EQ(part.to_before.begin + shift, before.from_after.begin);
      EXPECT_EQ(part.to_before.end + shift, before.from_after.end);
    }
  }
}

TEST(RowPartition, LeavesRanksOutWhereRowsAreFew) {
  const ExplicitModel model = plate();
  const auto rows = static_cast<Index>(model.lattice.rows.size());
  const Index fewest = reach.behind + reach.ahead + model.lattice.reach;
  for (const int ranks : {rows / fewest + 1, rows}) {
    const RowPartition partition(model.lattice, reach, ranks);
    EXPECT_GT(partition.count(), 1);
    EXPECT_LE(partition.count(), rows / fewest);
    for (int rank = 0; rank < partition.count(); ++rank) {
      EXPECT_GE(partition.own(rank).size(), fewest);
    }
  }
  EXPECT_EQ(RowPartition(model.lattice, {rows, rows, 1}, 4).count(), 1);
}

/// The bonds of a particle as its part has them are those of the body.
TEST(RowPartition, PartsKeepTheirBondsAndConditionsOnTheWay) {
  const ExplicitModel model = plate();
  const LatticeRows& body = model.lattice;
  const RowRange rows{20, 50};
  Parcel parcel;
  pack(cut_rows(model, rows), parcel);
  const ExplicitModel part = unpack_model(parcel);
  const LatticeRows& lattice = part.lattice;
  ASSERT_EQ(static_cast<Index>(lattice.rows.size()), rows.size());
  const Index shift = body.rows[rows.begin].first - lattice.rows[0].first;
  const LatticeParticles own(part), whole(model);
  const ExplicitState own_state(part), whole_state(model);
  Index count = 0;
  for_each_particle(lattice, [&](Index row, Index slot) {
    const auto neighbourhood = own.neighbourhood(own_state, row, slot);
    const auto wanted = whole.neighbourhood(whole_state, row + rows.begin, slot + shift);
    EXPECT_EQ(neighbourhood.mask, wanted.mask);
    EXPECT_EQ(own.is_near_face(slot), whole.is_near_face(slot + shift));
    for (int j = 0; j < neighbourhood.bonds; ++j) {
      EXPECT_EQ(neighbourhood.partner[j] + shift, wanted.partner[j]);
      ASSERT_GE(neighbourhood.partner[j], 0);
      ASSERT_LT(neighbourhood.partner[j], lattice.slots);
    }
    EXPECT_EQ(part.inverse_mass[slot], model.inverse_mass[slot + shift]);
    EXPECT_EQ(part.volume[slot], model.volume[slot + shift]);
    ++count;
  });
  EXPECT_EQ(count, lattice.particles());
  for (Index r = 0; r < rows.size(); ++r) {
    const auto &row = part.prescribed[r], &wanted = model.prescribed[r + rows.begin];
    ASSERT_EQ(row.size(), wanted.size());
    for (std::size_t k = 0; k < row.size(); ++k) EXPECT_EQ(row[k].slot + shift, wanted[k].slot);
  }
  EXPECT_EQ(part.material.softening.strength, model.material.softening.strength);
  EXPECT_EQ(part.bond_damping, model.bond_damping);
  std::vector<double> places(static_cast<std::size_t>(2 * body.slots));
  for (std::size_t k = 0; k < places.size(); ++k) places[k] = static_cast<double>(k);
  const std::vector<double> cut = cut_field(places, body, rows);
  ASSERT_EQ(static_cast<Index>(cut.size()), 2 * lattice.slots);
  EXPECT_EQ(cut[lattice.at(1, 0)] - cut[0], body.slots);
  EXPECT_EQ(cut[lattice.rows[0].first], body.rows[rows.begin].first);
}

}  // namespace
}  // namespace perilink
