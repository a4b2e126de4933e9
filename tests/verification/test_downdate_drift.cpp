#include <gtest/gtest.h>

#include "drift.hpp"
#include "problems/block.hpp"

namespace perilink::verification {
namespace {

/// The study's claims at 5 000 unknowns; the bars are those of the study at 50 000.
TEST(DowndateDrift, StaysBelowTheBarAfterThousandsOfDowndates) {
  const auto table = measure_drift(make_block(columns_5k), 2000, 2000);
  EXPECT_EQ(table.back().downdates, 2000);
  EXPECT_LT(table.back().residual, 1e-10);
  EXPECT_LT(table.back().error, 1e-10);
}

TEST(DowndateDrift, DetachmentLeavesTheRestExact) {
  const Model model = make_block(columns_5k);
  const std::pair<double, int> parts[] = {{0.1, 1}, {1.1, 7}, {2.1, 19}};
  for (const auto& [radius, particles] : parts) {
    const Detachment d = measure_detachment(model, 40.0, 140.0, radius);
    EXPECT_EQ(d.particles, particles);
    EXPECT_EQ(d.springs, particles == 1 ? 2 : 3);
    EXPECT_LT(d.error, 1e-12);
  }
}

}  // namespace
}  // namespace perilink::verification
