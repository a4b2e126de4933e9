#include "analysis/ranks/body_part.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "support/analysis_bodies.hpp"

namespace perilink {
namespace {

using namespace test;

class BodyPartTest : public testing::TestWithParam<Index> {
 protected:
  static constexpr int ranks = 3;
  BodyPartTest()
      : body_(make_block({.lattice = {"square", Pattern::rectangular, Surface::none},
                          .bar = true,
                          .columns = 30,
                          .scatter = 0.0,
                          .toothed = true,
                          .slipping = true})),
        partition_(body_.network, {body_.network.particles.size(), 2, GetParam()}, ranks) {
    for (Index e = 0; e < body_.network.num_elements(); ++e) {
      body_.network.hinged.push_back(static_cast<std::uint8_t>(e % 4));
    }
  }
  BodyPart part(int rank) const {
    return cut_part(body_.network, body_.unknowns, partition_, rank);
  }
  Index first(int rank) const { return partition_.first_particle[rank]; }

  AnalysisBody body_;
  Partition partition_;
};

TEST_P(BodyPartTest, EveryParticleHasOneOwner) {
  EXPECT_EQ(partition_.own_end(ranks - 1), body_.network.particles.size());
  for (int rank = 0; rank < ranks; ++rank) {
    EXPECT_LT(partition_.own_begin(rank), partition_.own_end(rank));
    EXPECT_EQ(partition_.own_begin(rank), rank > 0 ? partition_.own_end(rank - 1) : 0);
    for (Index p = partition_.own_begin(rank); p < partition_.own_end(rank); ++p) {
      ASSERT_EQ(partition_.owner(p), rank);
    }
    const BodyPart own = part(rank);
    EXPECT_EQ(own.first_particle + own.own_begin, partition_.own_begin(rank));
    EXPECT_EQ(own.owned(), partition_.own_end(rank) - partition_.own_begin(rank));
    EXPECT_EQ(own.own_begin % GetParam(), 0) << "blocks of a part are those of the body";
  }
}

TEST_P(BodyPartTest, HasTheElementsOfItsParticlesAndTheirOtherEnds) {
  for (int rank = 0; rank < ranks; ++rank) {
    const BodyPart own = part(rank);
    std::vector<bool> is_known(own.body.network.particles.volumes.size(), false);
    const auto is_own = [&](Index p) { return partition_.owner(p) == rank; };
    for (Index p = own.own_begin; p < own.own_end; ++p) is_known[p] = true;
    for (std::size_t g = 0; g < own.ghosts.places.size(); ++g) {
      const Index ghost = own.ghosts.places[g] + first(rank);
      EXPECT_EQ(own.ghosts.owners[g], partition_.owner(ghost));
      EXPECT_EQ(own.ghosts.numbers[g] + first(own.ghosts.owners[g]), ghost);
      is_known[own.ghosts.places[g]] = true;
    }
    std::size_t next = 0;
    for (Index e = 0; e < body_.network.num_elements(); ++e) {
      std::vector<Index> ends, own_ends;
      for_each_end(body_.network, e, [&](Index p, bool, double) { ends.push_back(p); });
      if (std::ranges::none_of(ends, is_own)) continue;
      ASSERT_EQ(own.elements.at(next), e);
      for_each_end(own.body.network, static_cast<Index>(next), [&](Index p, bool, double) {
        EXPECT_TRUE(is_known[p]);
        own_ends.push_back(p + first(rank));
      });
      EXPECT_EQ(own_ends, ends);
      EXPECT_EQ(own.body.network.is_embedded(static_cast<Index>(next)),
                body_.network.is_embedded(e));
      EXPECT_EQ(own.body.network.is_segment(static_cast<Index>(next)), body_.network.is_segment(e));
      EXPECT_EQ(own.body.network.stiffness[next], body_.network.stiffness[e]);
      EXPECT_EQ(own.body.network.hinged[next], body_.network.hinged[e]);
      ++next;
    }
    EXPECT_EQ(own.elements.size(), next);
  }
}

TEST_P(BodyPartTest, KeepsWhatBondsShare) {
  const BodyPart apart = part(1);
  share_directions(body_.network.bonds);
  ASSERT_FALSE(body_.network.bonds.kind.empty());
  const BodyPart together = part(1);
  const Bonds &single = apart.body.network.bonds, &shared = together.body.network.bonds;
  ASSERT_EQ(shared.second, single.second);
  for (Index e = 0; e < single.size(); ++e) {
    EXPECT_NEAR(shared.length(e), single.length(e), 1e-12 * single.length(e));
    EXPECT_NEAR(shared.direction(e)[0], single.direction(e)[0], 1e-12);
  }
}

TEST_P(BodyPartTest, ArrivesAsItWasSent) {
  const BodyPart sent = part(1);
  Parcel parcel;
  sent.pack(parcel);
  parcel.put(7.5);
  Parcel message({parcel.bytes().begin(), parcel.bytes().end()});
  const BodyPart come = BodyPart::unpack(message);
  EXPECT_EQ(message.get<double>(), 7.5) << "what follows in the message";
  const Network &network = come.body.network, &expected = sent.body.network;
  EXPECT_EQ(network.bonds.first, expected.bonds.first);
  EXPECT_EQ(network.bonds.directions, expected.bonds.directions);
  EXPECT_EQ(network.stiffness, expected.stiffness);
  EXPECT_EQ(network.critical_stretch, expected.critical_stretch);
  EXPECT_EQ(network.hinged, expected.hinged);
  EXPECT_EQ(network.embedded_points.weights, expected.embedded_points.weights);
  EXPECT_EQ(network.first_embedded_slip_spring, expected.first_embedded_slip_spring);
  ASSERT_EQ(network.laws.size(), expected.laws.size());
  for (const int segment : {0, 1, 2, 3}) {
    EXPECT_EQ(network.laws[0].segment(segment).secant, expected.laws[0].segment(segment).secant);
    EXPECT_EQ(network.laws[0].segment(segment).limit, expected.laws[0].segment(segment).limit);
  }
  EXPECT_EQ(come.body.unknowns.number, sent.body.unknowns.number);
  EXPECT_EQ(come.body.unknowns.prescribed, sent.body.unknowns.prescribed);
  EXPECT_EQ(come.elements, sent.elements);
  EXPECT_EQ(come.ghosts.places, sent.ghosts.places);
  EXPECT_EQ(come.ghosts.owners, sent.ghosts.owners);
  EXPECT_EQ(come.ghosts.numbers, sent.ghosts.numbers);
  EXPECT_EQ(come.own_begin, sent.own_begin);
  EXPECT_EQ(come.own_end, sent.own_end);
}

INSTANTIATE_TEST_SUITE_P(BlocksOf, BodyPartTest, testing::Values(1, 256));

}  // namespace
}  // namespace perilink
