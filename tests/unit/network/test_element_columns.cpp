#include "network/network.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

#include "support/small_networks.hpp"

namespace perilink {
namespace {

using namespace test;

TEST(KeepElements, TakesBondsOutOfEveryList) {
  Network network = make_network({"", Pattern::rectangular, Surface::none}, 4);
  network.bending.assign(network.stiffness.begin(), network.stiffness.end());
  network.bending_ratio.assign(network.stiffness.begin(), network.stiffness.end());
  network.hinged.assign(network.stiffness.size(), 0);
  network.hinged[3] = first_end;
  const Network whole = network;
  std::vector<std::uint8_t> keep(whole.stiffness.size());
  std::vector<Index> kept;
  for (std::size_t e = 0; e < keep.size(); ++e) {
    keep[e] = e % 3 != 1;
    if (keep[e]) kept.push_back(static_cast<Index>(e));
  }
  keep_elements(network, keep);
  ASSERT_EQ(network.num_elements(), static_cast<Index>(kept.size()));
  ASSERT_EQ(network.stiffness.size(), kept.size());
  ASSERT_EQ(network.bending.size(), kept.size());
  ASSERT_EQ(network.bending_ratio.size(), kept.size());
  ASSERT_EQ(network.critical_stretch.size(), kept.size());
  ASSERT_EQ(network.hinged.size(), kept.size());
  for (std::size_t e = 0; e < kept.size(); ++e) {
    EXPECT_EQ(network.bonds.first[e], whole.bonds.first[kept[e]]);
    EXPECT_EQ(network.bonds.second[e], whole.bonds.second[kept[e]]);
    EXPECT_EQ(network.stiffness[e], whole.stiffness[kept[e]]);
    EXPECT_EQ(network.hinged[e], whole.hinged[kept[e]]);
    EXPECT_EQ(network.bending[e], whole.stiffness[kept[e]]);
    EXPECT_EQ(network.bending_ratio[e], whole.stiffness[kept[e]]);
  }
}

/// A list that is too long belongs to other elements: its values would go to the wrong ones.
TEST(KeepElements, RefusesListsLongerThanTheBonds) {
  Network network;
  network.stiffness = {1.0, 2.0, 3.0};
  const std::vector<std::uint8_t> keep;
  EXPECT_THROW(keep_elements(network, keep), std::logic_error);
}

}  // namespace
}  // namespace perilink
