#include "calibration/bounded_least_squares/subdomain_modes.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace perilink {
namespace {

/// Three fields on four rows.
const std::vector<double> fields = {1.0, 2.0, 3.0, 4.0, 0.5, 0.0, -0.5, 1.0, 8.0, 4.0, 2.0, 1.0};

TEST(SubdomainModes, SumsValuesOfTheRowsFromOneOn) {
  const SubdomainModes box(3, fields);
  EXPECT_EQ(box.count(), 3U);
  std::vector<double> sums = {1.0, 0.0, 0.0};
  const std::vector<double> values = {1.0, -2.0};
  box.add_sums(1, values, sums.data());
  EXPECT_EQ(sums, (std::vector<double>{1.0 + 2.0 - 6.0, 0.0 + 1.0, 4.0 - 4.0}));
}

TEST(SubdomainModes, AddsFieldsByTheirShares) {
  const SubdomainModes box(3, fields);
  std::vector<double> values(4, 1.0);
  box.add_fields(std::vector<double>{1.0, 2.0, -0.5}, values.data());
  EXPECT_EQ(values, (std::vector<double>{-1.0, 1.0, 2.0, 6.5}));
}

TEST(SubdomainModes, AreKeptInSinglePrecision) {
  const SubdomainModes box(1, std::vector<double>{0.1, 2.0});
  EXPECT_EQ(box.values(), (std::vector<double>{static_cast<double>(0.1F), 2.0}));
  const SubdomainModes none(0, {});
  EXPECT_TRUE(none.values().empty());
}

}  // namespace
}  // namespace perilink
