#include "analysis/quasistatic/host_release.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "model/from_case/configure.hpp"
#include "support/strip_case.hpp"

namespace perilink {
namespace {

/// Forty by eighty with particles 2.5 apart: four by eight elements of four spacings, less those at
/// the ends that supports hold in part.
Model strip_model() {
  std::string text = test::strip_text;
  text.replace(text.find("spacing = 10.0"), 14, "spacing = 2.5");
  text.replace(text.find("horizon = 31.0"), 14, "horizon = 7.6");
  return build_model(parse_case(text + "[elements]\nspacings = 4\norder = 1\nhalo = 1.0\n", "c"));
}

TEST(HostRelease, FreesTheElementAndItsNeighbours) {
  const Model model = strip_model();
  ASSERT_TRUE(model.embedded);
  HostRelease host_release(model.network, *model.embedded);
  const std::vector<Index> embedded = host_release.embedded_bonds();
  const Index before = host_release.num_whole();
  ASSERT_GT(before, 9);
  // A bond in the middle of the strip, within one element.
  const auto in_the_middle = [&](Index bond) {
    for (const Index i : {model.network.bonds.first[bond], model.network.bonds.second[bond]}) {
      const auto x = model.network.particles.position(i);
      if (x[0] <= 10.0 || x[0] >= 20.0 || x[1] <= 40.0 || x[1] >= 50.0) return false;
    }
    return true;
  };
  const auto bond = std::find_if(embedded.begin(), embedded.end(), in_the_middle);
  ASSERT_NE(bond, embedded.end());
  const Unknowns& motion = host_release.convert(host_release.hosts_of({{*bond}}));
  EXPECT_EQ(host_release.num_whole(), before - 9) << "those that it touches";
  EXPECT_GT(motion.count, model.unknowns.count);
  EXPECT_FALSE(host_release.is_embedded(*bond));
  const std::vector<Index> after = host_release.embedded_bonds();
  std::vector<Index> freed;
  std::set_difference(embedded.begin(), embedded.end(), after.begin(), after.end(),
                      std::back_inserter(freed));
  EXPECT_EQ(host_release.freed(), freed);
}

TEST(HostRelease, EndsWithTheMotionOfFreeParticles) {
  const Model model = strip_model();
  HostRelease host_release(model.network, *model.embedded);
  const Unknowns& motion =
      host_release.convert(host_release.hosts_of(host_release.embedded_bonds()));
  EXPECT_EQ(host_release.num_whole(), 0);
  EXPECT_FALSE(motion.carries());
  EXPECT_EQ(motion.number, model.embedded->free.number);
}

/// A strain of 0.02 along y in the lower half, 0.01 in the upper one.
TEST(HostRelease, FindsTheElementsThatAreStrainedTheMost) {
  Model model = strip_model();
  model.embedded->release_strain = 0.03;
  HostRelease host_release(model.network, *model.embedded);
  EXPECT_EQ(host_release.release_threshold(), 1.0) << "bonds give none before their limits";
  std::vector<double> motion;
  for (Index i = 0; i < model.network.particles.size(); ++i) {
    const double y = model.network.particles.position(i)[1];
    motion.insert(motion.end(), {0.0, y < 40.0 ? 0.02 * y : 0.4 + 0.01 * y});
  }
  const auto [elements, load_factor] = host_release.strained(motion, 0.9);
  EXPECT_NEAR(load_factor, 1.5, 1e-12);
  for (Index e = 0; e < model.embedded->hosts.size(); ++e) {
    const bool lower = model.embedded->hosts.upper[static_cast<std::size_t>(e) * 2 + 1] < 41.0;
    EXPECT_EQ(elements[e] != 0, lower && host_release.whole()[e] != 0) << e;
  }
  host_release.convert(elements);
  EXPECT_NEAR(host_release.strained(motion, 0.9).load_factor, 3.0, 1e-12) << "the next ones";
}

TEST(HostRelease, StrainsOfCompressionGiveNoAlert) {
  Model model = strip_model();
  model.embedded->release_strain = 0.03;
  HostRelease host_release(model.network, *model.embedded);
  std::vector<double> motion;
  for (Index i = 0; i < model.network.particles.size(); ++i) {
    motion.insert(motion.end(), {0.0, -0.01 * model.network.particles.position(i)[1]});
  }
  const auto [elements, load_factor] = host_release.strained(motion, 0.9);
  EXPECT_TRUE(std::isinf(load_factor));
  EXPECT_EQ(std::count(elements.begin(), elements.end(), 1), 0);
}

}  // namespace
}  // namespace perilink
