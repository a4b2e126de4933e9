#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "analysis/quasistatic/equilibrium/equilibrium.hpp"
#include "model/from_case/configure.hpp"
#include "support/strip_case.hpp"

namespace perilink {
namespace {

/// A strip pulled by forces, in which only bonds of the middle can break.
Model current_model(const std::string& more) {
  return build_model(parse_case(std::string(R"([body]
spacing = 2.5
horizon_ratio = 3
[[regions]]
name = "strip"
x = [0, 40]
y = [0, 80]
[[regions]]
name = "lower"
x = [0, 40]
y = [0, 30]
[[regions]]
name = "upper"
x = [0, 40]
y = [50, 80]
[[regions]]
name = "bottom"
x = [0, 40]
y = [0, 0]
[[regions]]
name = "top"
x = [0, 40]
y = [80, 80]
[[materials]]
region = "strip"
youngs_modulus = 100.0
fracture_energy = 0.1
[[materials]]
regions = ["lower", "upper"]
youngs_modulus = 100.0
fracture_energy = "infinite"
[[supports]]
region = "bottom"
fix = ["x", "y"]
[[loads]]
region = "top"
force = [0, 10]
)") + more,
                                "strip.toml"));
}

/// Breaks bonds one after the other next to the left edge. 1e-10: round-off of the factor.
void expect_current(const Model& model) {
  Equilibrium equilibrium(model, {});
  const Network& network = model.network;
  const auto width = static_cast<std::size_t>(network.width());
  int broken = 0;
  double apart_elsewhere = 0.0;
  for (Index e = 0; e < network.num_elements() && broken < 20; ++e) {
    const auto x = network.particles.position(network.bonds.first[e]);
    if (!network.can_break(e) || x[0] > 6.0) continue;
    ASSERT_FALSE(equilibrium.weaken(e, 0.0).mechanism);
    ++broken;
    const std::span<const double> found = equilibrium.where_elements_fail();
    const std::vector<double> events(found.begin(), found.end());
    const std::span<const double> all = equilibrium.displacement();
    double largest = 0.0;
    for (const double u : all) largest = std::max(largest, std::abs(u));
    std::vector<std::uint8_t> looked_at(all.size(), 0);
    for (Index b = 0; b < network.num_elements(); ++b) {
      if (!network.has_limit(b)) continue;
      for (const Index i : {network.bonds.first[b], network.bonds.second[b]}) {
        for (std::size_t a = 0; a < width; ++a)
          looked_at[static_cast<std::size_t>(i) * width + a] = 1;
      }
    }
    for (std::size_t slot = 0; slot < all.size(); ++slot) {
      const double apart = std::abs(events[slot] - all[slot]);
      if (looked_at[slot] != 0) {
        EXPECT_LT(apart, 1e-10 * largest);
      } else {
        apart_elsewhere = std::max(apart_elsewhere, apart / largest);
      }
    }
  }
  EXPECT_EQ(broken, 20);
  EXPECT_GT(apart_elsewhere, 1e-6) << "events keep no more current than they need";
}

TEST(Current, EventsKeepWhatASearchLooksAt) { expect_current(current_model("")); }

TEST(Current, EventsKeepWhatASearchLooksAtBesideElements) {
  const Model model = current_model("[elements]\nspacings = 4\norder = 1\n");
  ASSERT_TRUE(model.unknowns.carries());
  expect_current(model);
}

}  // namespace
}  // namespace perilink
