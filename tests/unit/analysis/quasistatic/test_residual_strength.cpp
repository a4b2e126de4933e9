#include "analysis/quasistatic/residual_strength.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "analysis/quasistatic/damage_state.hpp"
#include "support/strip_case.hpp"

namespace perilink {
namespace {

/// Bonds across x = 15 in a strip of 40 by 80, from below.
std::vector<Index> bonds_across(const Network& network) {
  const Particles& particles = network.particles;
  std::vector<Index> across;
  for (Index b = 0; b < network.bonds.size(); ++b) {
    const double from = particles.position(network.bonds.first[b])[0];
    const double to = particles.position(network.bonds.second[b])[0];
    if (std::min(from, to) < 15.0 && std::max(from, to) > 15.0) across.push_back(b);
  }
  const auto height = [&](Index b) {
    return particles.position(network.bonds.first[b])[1] +
           particles.position(network.bonds.second[b])[1];
  };
  std::ranges::stable_sort(across, {}, height);
  return across;
}

/// Rows in which the bonds fail one after the other, `events` times each.
std::vector<StepRecord> rows_of(const std::vector<Index>& bonds, int events = 1) {
  std::vector<StepRecord> rows;
  for (int k = 0; k < events; ++k) {
    for (const Index bond : bonds) rows.emplace_back().element = bond;
  }
  return rows;
}

/// The middles of the bonds reach from y = 0 to 64 or more.
TEST(ThroughCrack, SpansFourFifthsOfTheBody) {
  const Network network = build_model(test::strip_case()).network;
  const std::vector<Index> across = bonds_across(network);
  const std::vector<StepRecord> rows = rows_of(across);
  const auto reaches = std::ranges::find_if(across, [&](Index b) {
    return network.particles.position(network.bonds.first[b])[1] +
               network.particles.position(network.bonds.second[b])[1] >=
           2.0 * 64.0;
  });
  const auto expected = static_cast<std::size_t>(reaches - across.begin()) + 1;
  ASSERT_GT(expected, across.size() / 2);
  EXPECT_EQ(rows_before_through_crack(network, rows), expected);
  EXPECT_EQ(rows_before_through_crack(network, std::span(rows).first(expected - 1)), expected - 1);
}

/// Forces at the limits are 1, 0.6 and 0.3: the second event brings a bond below half.
TEST(ThroughCrack, IsMadeOfBondsBelowHalfOfTheirForce) {
  Network network = build_model(test::strip_case()).network;
  network.laws = {BondLaw::saw_tooth({{1.0, 1.0}, {0.3, 2.0}, {0.1, 3.0}})};
  const std::vector<Index> across = bonds_across(network);
  EXPECT_EQ(rows_before_through_crack(network, rows_of(across)), across.size());
  EXPECT_GT(rows_before_through_crack(network, rows_of(across, 2)), across.size());
  EXPECT_LT(rows_before_through_crack(network, rows_of(across, 2)), 2 * across.size());
}

/// Loads climb by half once the crack has gone through.
TEST(Peaks, EndWithTheCrackThroughTheBody) {
  Network network = build_model(test::strip_case()).network;
  std::vector<StepRecord> rows = rows_of(bonds_across(network));
  const std::size_t through = rows_before_through_crack(network, rows);
  network.laws.push_back(BondLaw::plateau());  // bodies of brittle bonds have another rule
  const auto result_of = [&](double later) {
    DamageResult result;
    for (std::size_t k = 0; k < rows.size(); ++k) {
      rows[k].displacement = 1.0 + static_cast<double>(k);
      rows[k].load = k < through ? 10.0 + 0.001 * static_cast<double>(k) : later;
      result.peaks.add({rows[k].displacement, rows[k].load});
    }
    find_peaks(network, rows, result);
    return result;
  };
  const DamageResult climbed = result_of(15.0);
  EXPECT_EQ(climbed.peak_load, rows[through - 1].load);
  EXPECT_EQ(climbed.peak_displacement, static_cast<double>(through));
  EXPECT_EQ(climbed.peaks.highest().load, 15.0);
  EXPECT_TRUE(climbed.peaks.climbed_again());
  EXPECT_EQ(result_of(11.0).peak_load, 11.0) << "by less than a tenth";
}

/// A stage beside permanent loads that store as much as its load case at `held`.
class StageBeside {
 public:
  explicit StageBeside(double held) : held_(held) { network_.laws.push_back(BondLaw::plateau()); }
  void add(double load, double compliance, Index events = 1) {
    StepRecord& row = rows_.emplace_back();
    row.element = no_index;
    row.stage = 2;
    row.events = events;
    row.load = load;
    row.displacement = compliance * load;
    row.equivalent_load = std::hypot(load, held_);
    row.strain_energy = 0.5 * compliance * row.equivalent_load * row.equivalent_load;
    result_.peaks.add({row.displacement, row.load});
  }
  const DamageResult& result() {
    find_peaks(network_, rows_, result_);
    return result_;
  }

 private:
  Network network_ = build_model(test::strip_case()).network;
  double held_;
  std::vector<StepRecord> rows_;
  DamageResult result_;
};

/// A constant shear force damages the body while the tension of the next stage is still near zero,
/// and its load swings.
TEST(Peaks, AreNoSwingsOfAStageBesideLargerLoads) {
  StageBeside stage(5000.0);
  for (const double load : {95.0, -223.0, 62.0, 339.0}) stage.add(load, 1e-6);
  for (int k = 1; k <= 40; ++k) stage.add(300.0 * k, 1e-6 + 1e-9 * k);
  for (int k = 1; k <= 40; ++k) stage.add(12000.0 - 250.0 * k, 1.1e-6 + 1e-7 * k);
  EXPECT_EQ(stage.result().peak_load, 12000.0);
  EXPECT_FALSE(stage.result().peaks.climbed_again());
}

/// The body loses most of its stiffness at 12; the pieces carry 30 beside the loads before.
TEST(Peaks, AreFoundBesideSmallerLoads) {
  for (const double held : {0.0, 3.0}) {
    StageBeside stage(held);
    for (int k = 1; k <= 12; ++k) stage.add(k, 1.0);
    for (int k = 1; k <= 9; ++k) stage.add(12.0 - k, 1.0 + 0.5 * k);
    for (int k = 1; k <= 30; ++k) stage.add(k, 6.0);
    EXPECT_EQ(stage.result().peak_load, 12.0);
    EXPECT_EQ(stage.result().peaks.highest().load, 30.0);
  }
}

/// Stages unload the body and turn its load before it softens at 12.
TEST(Peaks, AreNoEndsOfStagesThatUnloadTheBody) {
  for (const double sign : {1.0, -1.0}) {
    StageBeside stage(0.0);
    for (const double load : {3.0, 0.5, 4.0, -3.0}) stage.add(sign * load, 1.0, 0);
    for (int k = 7; k <= 12; ++k) stage.add(sign * k, 1.0);
    stage.add(sign * 2.0, 1.0, 0);
    for (int k = 1; k <= 9; ++k) stage.add(sign * (12.0 - k), 1.0 + 0.5 * k);
    EXPECT_EQ(stage.result().peak_load, 12.0 * sign);
    EXPECT_FALSE(stage.result().peaks.climbed_again());
    ASSERT_TRUE(stage.result().other_peak);
    EXPECT_EQ(stage.result().other_peak->load, -3.0 * sign);
  }
}

/// Bonds fail at -30 and at 10 in turn. The fall behind 12 ends the loads of its sign.
TEST(Peaks, HaveFallsOfTheirOwnSign) {
  StageBeside stage(0.0);
  for (const double load : {8.0, -20.0, 9.0, -30.0, 10.0, 12.0}) stage.add(load, 1.0);
  for (int k = 1; k <= 9; ++k) stage.add(12.0 - k, 1.0 + 0.5 * k);
  EXPECT_EQ(stage.result().peak_load, -30.0);
  EXPECT_FALSE(stage.result().peaks.climbed_again());
  for (int k = 1; k <= 20; ++k) stage.add(k, 6.0);
  ASSERT_TRUE(stage.result().other_peak);
  EXPECT_EQ(stage.result().other_peak->load, 12.0) << "20 is residual strength";
}

/// The body tears at 12, and its closed cracks carry 40.
TEST(Peaks, EndWhereTheBodyGaveWayBeforeItsCracksClose) {
  for (const double sign : {1.0, -1.0}) {
    StageBeside stage(0.0);
    for (int k = 1; k <= 12; ++k) stage.add(sign * k, 1.0);
    for (int k = 1; k <= 9; ++k) stage.add(sign * (12.0 - k), 1.0 + k * k);
    stage.add(sign * -40.0, 1.0, 0);
    EXPECT_EQ(stage.result().peak_load, 12.0 * sign);
    EXPECT_EQ(stage.result().peaks.highest().load, -40.0 * sign);
  }
}

/// A twentieth of the peak is told, less is not.
TEST(Peaks, OfTheOtherSignAreNoSwings) {
  for (const double other : {-4.0, -6.0}) {
    StageBeside stage(0.0);
    for (const double load : {other, 50.0, 100.0}) stage.add(load, 1.0);
    EXPECT_EQ(stage.result().other_peak.has_value(), other == -6.0);
  }
}

/// A stage of a run that has carried -100 and 40 before.
class LoadFraction : public testing::Test {
 protected:
  LoadFraction() {
    path_.load_fraction = 0.3;
    path_.largest = {40.0, 100.0};
  }
  bool is_below_at(double load) {
    StepRecord row;
    row.load = load;
    return is_below(row, path_);
  }
  PathState path_;
};

TEST_F(LoadFraction, IsThatOfTheLargestLoadOfTheSameSign) {
  path_.largest_of_stage = {40.0, 0.0};
  EXPECT_FALSE(is_below_at(13.0));
  EXPECT_TRUE(is_below_at(11.0));
  path_.largest_of_stage = {40.0, 100.0};
  EXPECT_FALSE(is_below_at(-31.0));
  EXPECT_TRUE(is_below_at(-29.0));
}

TEST_F(LoadFraction, IsNotReachedByARisingLoad) {
  path_.largest_of_stage = {5.0, 0.0};
  EXPECT_FALSE(is_below_at(5.0));
  EXPECT_TRUE(is_below_at(4.9));
}

/// Rows that hold back earlier loads are not among the largest.
TEST_F(LoadFraction, OfALoadHeldBackIsThatOfTheLoadsBefore) {
  path_.largest_of_stage = {40.0, 0.0};
  EXPECT_TRUE(is_below_at(-11.0));
  EXPECT_FALSE(is_below_at(-13.0));
}

}  // namespace
}  // namespace perilink
