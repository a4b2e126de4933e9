#include "app/report/report_units.hpp"

#include <gtest/gtest.h>

namespace perilink {
namespace {

TEST(ReportUnits, AreReadFromTheText) {
  const UnitNames three = UnitNames::of("kip, in, s");
  EXPECT_EQ(three.force, "kip");
  EXPECT_EQ(three.length, "in");
  EXPECT_EQ(three.time, "s");
  const UnitNames two = UnitNames::of("N,mm");
  EXPECT_EQ(two.length, "mm");
  EXPECT_EQ(two.time, "");
  EXPECT_EQ(UnitNames::of("").force, "");
}

TEST(ReportUnits, FollowTheQuantity) {
  const UnitNames units = UnitNames::of("N, mm, s");
  EXPECT_EQ(unit_of_quantity("youngs_modulus", units), "N/mm²");
  EXPECT_EQ(unit_of_quantity("fracture_energy", units), "N/mm");
  EXPECT_EQ(unit_of_quantity("strain_energy_density", units), "N/mm²");
  EXPECT_EQ(unit_of_quantity("dissipated_energy", units), "N mm");
  EXPECT_EQ(unit_of_quantity("smoothed_peak_load", units), "N");
  EXPECT_EQ(unit_of_quantity("load_factor", units), "");
  EXPECT_EQ(unit_of_quantity("largest_opening", units), "mm");
  EXPECT_EQ(unit_of_quantity("velocity", units), "mm/s");
  EXPECT_EQ(unit_of_quantity("damage", units), "");
}

TEST(ReportUnits, AreLeftOutWhereOneIsUnknown) {
  EXPECT_EQ(unit_of_quantity("velocity", UnitNames::of("N, mm")), "");
  EXPECT_EQ(unit_of_quantity("load", {}), "");
}

TEST(ReportUnits, NamesGetBlanks) { EXPECT_EQ(in_words("youngs_modulus"), "youngs modulus"); }

}  // namespace
}  // namespace perilink
