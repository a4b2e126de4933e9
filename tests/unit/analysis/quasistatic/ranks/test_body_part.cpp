#include "analysis/quasistatic/ranks/body_part.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "support/analysis_bodies.hpp"

namespace perilink {
namespace {

using namespace test;

class BodyPartTest : public testing::Test {
 protected:
  BodyPartTest()
      : body_(make_block({{"square", Pattern::rectangular, Surface::none}})),
        secants_(intact(body_.network)),
        motions_(body_.network, secants_, body_.unknowns, 9),
        stiffness_(assemble_subdomain_stiffness(body_.network, secants_, body_.unknowns, motions_)),
        partition_(share_out(body_.network, body_.unknowns, 3)) {}
  BodyPart part(int rank) const {
    return cut_part(body_.network, secants_, body_.unknowns, motions_, stiffness_, partition_,
                    rank);
  }

  AnalysisBody body_;
  std::vector<double> secants_;
  SubdomainMotions motions_;
  SubdomainStiffness stiffness_;
  Partition partition_;
};

TEST_F(BodyPartTest, EveryParticleAndUnknownHasOneOwner) {
  std::vector<GlobalIndex> particles, unknowns;
  for (int rank = 0; rank < 3; ++rank) {
    particles.insert(particles.end(), partition_.particles[rank].begin(),
                     partition_.particles[rank].end());
    unknowns.insert(unknowns.end(), partition_.unknowns[rank].begin(),
                    partition_.unknowns[rank].end());
    EXPECT_EQ(part(rank).owned(), static_cast<Index>(partition_.particles[rank].size()));
    EXPECT_EQ(part(rank).unknowns.count, static_cast<Index>(partition_.unknowns[rank].size()));
  }
  std::sort(particles.begin(), particles.end());
  std::sort(unknowns.begin(), unknowns.end());
  for (std::size_t k = 0; k < particles.size(); ++k) EXPECT_EQ(particles[k], GlobalIndex(k));
  EXPECT_EQ(particles.size(), static_cast<std::size_t>(body_.network.particles.size()));
  for (std::size_t k = 0; k < unknowns.size(); ++k) EXPECT_EQ(unknowns[k], GlobalIndex(k));
  EXPECT_EQ(unknowns.size(), static_cast<std::size_t>(body_.unknowns.count));
}

TEST_F(BodyPartTest, HasTheElementsOfItsParticlesAndTheirOtherEnds) {
  const BodyPart own = part(1);
  std::vector<GlobalIndex> numbers = partition_.particles[1];  // in the whole body, ghosts behind
  for (std::size_t g = 0; g < own.ghosts.owners.size(); ++g) {
    EXPECT_NE(own.ghosts.owners[g], 1);
    numbers.push_back(partition_.particles[own.ghosts.owners[g]][own.ghosts.numbers[g]]);
  }
  std::vector<std::pair<GlobalIndex, GlobalIndex>> ends, expected;
  const Bonds& bonds = own.network.bonds;
  for (Index e = 0; e < bonds.size(); ++e) {
    ends.emplace_back(numbers[bonds.first[e]], numbers[bonds.second[e]]);
  }
  const auto is_own = [&](GlobalIndex p) {
    return std::binary_search(partition_.particles[1].begin(), partition_.particles[1].end(), p);
  };
  const Bonds& all = body_.network.bonds;
  for (Index e = 0; e < all.size(); ++e) {
    const GlobalIndex i{all.first[e]}, j{all.second[e]};
    if (is_own(i) || is_own(j)) expected.emplace_back(i, j);
  }
  EXPECT_EQ(ends, expected);
}

TEST_F(BodyPartTest, ArrivesAsItWasSent) {
  for (Index e = 0; e < body_.network.num_elements(); ++e) {
    body_.network.hinged.push_back(e % 2 == 0 ? second_end : 0);
  }
  const BodyPart sent = part(2);
  const Parcel parcel = sent.pack();
  const BodyPart come = BodyPart::unpack(Parcel({parcel.bytes().begin(), parcel.bytes().end()}));
  EXPECT_EQ(come.network.bonds.first, sent.network.bonds.first);
  EXPECT_EQ(come.network.bonds.directions, sent.network.bonds.directions);
  EXPECT_EQ(come.network.stiffness, sent.network.stiffness);
  EXPECT_EQ(come.network.hinged, sent.network.hinged);
  EXPECT_NE(std::count(come.network.hinged.begin(), come.network.hinged.end(), second_end), 0);
  EXPECT_EQ(come.unknowns.number, sent.unknowns.number);
  EXPECT_EQ(come.unknowns.count, sent.unknowns.count);
  EXPECT_EQ(come.ghosts.numbers, sent.ghosts.numbers);
  EXPECT_EQ(come.blocks, sent.blocks);
  EXPECT_EQ(come.rows, sent.rows);
  EXPECT_EQ(come.owned(), sent.owned());
  EXPECT_TRUE(come.coarse.isApprox(sent.coarse, 0.0));
}

}  // namespace
}  // namespace perilink
