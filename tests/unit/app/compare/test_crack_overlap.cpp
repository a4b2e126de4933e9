#include "app/compare/crack_overlap.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

namespace perilink {
namespace {

/// A square or cube of side 10 in cells, cracked where `is_cracked` is true at their centres.
CrackPattern cracked_block(int dim, double spacing,
                           const std::function<bool(double, double)>& is_cracked) {
  CrackPattern pattern;
  pattern.dim = dim;
  const int cells = static_cast<int>(std::lround(10.0 / spacing));
  for (int k = 0; k < (dim == 3 ? cells : 1); ++k) {
    for (int j = 0; j < cells; ++j) {
      for (int i = 0; i < cells; ++i) {
        const double x = spacing * (i + 0.5), y = spacing * (j + 0.5);
        pattern.positions.insert(pattern.positions.end(), {x, y});
        if (dim == 3) pattern.positions.push_back(spacing * (k + 0.5));
        pattern.volumes.push_back(std::pow(spacing, dim));
        pattern.damage.push_back(is_cracked(x, y) ? cracked_damage : 0.99 * cracked_damage);
      }
    }
  }
  return pattern;
}

bool column(double x, double low) { return x > low && x < low + 1.0; }

TEST(CrackOverlap, ACrackCoversItself) {
  for (const int dim : {2, 3}) {
    const CrackPattern body =
        cracked_block(dim, 1.0, [](double x, double) { return column(x, 3.0); });
    const CrackOverlap found = crack_overlap(body, body, 3.0);
    EXPECT_EQ(found.volume_a, dim == 2 ? 10.0 : 100.0);
    EXPECT_EQ(found.volume_b, found.volume_a);
    EXPECT_EQ(found.near_a, 1.0);
    EXPECT_EQ(found.near_b, 1.0);
    EXPECT_EQ(found.overlap, 1.0);
  }
}

TEST(CrackOverlap, ParallelCracksAreNearWithinTheTolerance) {
  const CrackPattern a = cracked_block(2, 1.0, [](double x, double) { return column(x, 3.0); });
  const CrackPattern b = cracked_block(2, 1.0, [](double x, double) { return column(x, 5.0); });
  EXPECT_EQ(crack_overlap(a, b, 2.5).near_a, 1.0);
  EXPECT_EQ(crack_overlap(a, b, 1.5).near_a, 0.0);
  EXPECT_EQ(crack_overlap(a, b, 2.5).overlap, 0.0);
}

TEST(CrackOverlap, AShortCrackCoversHalfOfALongOne) {
  const CrackPattern whole = cracked_block(2, 1.0, [](double x, double) { return column(x, 3.0); });
  const CrackPattern half =
      cracked_block(2, 1.0, [](double x, double y) { return column(x, 3.0) && y < 5.0; });
  const CrackOverlap found = crack_overlap(whole, half, 1.5);
  EXPECT_EQ(found.near_a, 0.6) << "one cell beyond the tip is near it";
  EXPECT_EQ(found.near_b, 1.0);
  EXPECT_EQ(found.overlap, 0.5);
}

TEST(CrackOverlap, SpacingsMayDiffer) {
  const auto band = [](double x, double) { return x > 2.0 && x < 4.0; };
  const CrackOverlap found =
      crack_overlap(cracked_block(2, 1.0, band), cracked_block(2, 0.5, band), 3.0);
  EXPECT_EQ(found.volume_a, 20.0);
  EXPECT_EQ(found.volume_b, 20.0);
  EXPECT_EQ(found.overlap, 1.0);
}

TEST(CrackOverlap, WithoutCracksThereAreNoShares) {
  const CrackPattern intact = cracked_block(2, 1.0, [](double, double) { return false; });
  const CrackPattern cracked =
      cracked_block(2, 1.0, [](double x, double) { return column(x, 3.0); });
  const CrackOverlap none = crack_overlap(intact, intact, 3.0);
  EXPECT_EQ(none.volume_a, 0.0);
  EXPECT_TRUE(std::isnan(none.near_a) && std::isnan(none.near_b) && std::isnan(none.overlap));
  const CrackOverlap one = crack_overlap(cracked, intact, 3.0);
  EXPECT_EQ(one.near_a, 0.0);
  EXPECT_TRUE(std::isnan(one.near_b));
  EXPECT_EQ(one.overlap, 0.0);
}

}  // namespace
}  // namespace perilink
