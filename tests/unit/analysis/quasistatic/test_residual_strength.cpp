#include "analysis/quasistatic/residual_strength.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

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
  void add(double load, double compliance) {
    StepRecord& row = rows_.emplace_back();
    row.element = no_index;
    row.stage = 2;
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

}  // namespace
}  // namespace perilink
