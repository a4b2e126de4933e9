#include "model/body/horizon_limits.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "model/from_case/configure.hpp"
#include "support/strip_case.hpp"

namespace perilink {
namespace {

using test::strip_case;
using ::testing::AllOf;
using ::testing::HasSubstr;

std::string answer(const HorizonReach& reach, AnalysisType type = AnalysisType::damage,
                   LinearSolver solver = LinearSolver::automatic) {
  CaseFile input = strip_case();
  input.analysis.type = type;
  input.analysis.solver = solver;
  try {
    refuse_impossible_horizon(input, reach);
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

/// A block of 300 x 300 x 300 cells of size one.
HorizonReach block(double horizon, double memory) {
  HorizonReach reach = reach_of(Box{{0, 0, 0}, {300, 300, 300}}, 3, horizon, 1.0);
  reach.memory = memory;
  return reach;
}

TEST(HorizonLimits, HoldTheBondsAgainstMemoryAndNumbers) {
  EXPECT_DOUBLE_EQ(block(3, 1e9).particles, 2.7e7);
  // 113 neighbours of 27 million particles make 1.5e9 bonds, 458 GB.
  EXPECT_THAT(answer(block(3, 1e11)),
              AllOf(HasSubstr("body.horizon: makes the horizon 3, 3 spacings"),
                    HasSubstr("2.7e+07 particles would have 113 neighbours"),
                    HasSubstr("1.5e+09 bonds and 458 GB; this machine has 100 GB")));
  EXPECT_EQ(answer(block(3, 5e11)), "accepted");
  EXPECT_THAT(answer(block(6, 1e99)), HasSubstr("at most 2.1e+09 bonds can be numbered"));
}

/// 10 million unknowns by two ranks hold 65 bytes a bond at most, not 300.
TEST(HorizonLimits, HoldFewerBytesForElasticBonds) {
  EXPECT_EQ(answer(block(3, 1e11), AnalysisType::elastic), "accepted");
  EXPECT_THAT(answer(block(3, 9e10), AnalysisType::elastic), HasSubstr("and 99.2 GB"));
  EXPECT_THAT(answer(block(3, 1e11), AnalysisType::elastic, LinearSolver::direct),
              HasSubstr("and 458 GB"));
}

TEST(HorizonLimits, CountNoNeighboursBesideSlenderBodies) {
  // 2 rows, 121 columns within reach of each; a full circle would have 11310.
  HorizonReach reach = reach_of(Box{{0, 0, 0}, {200000, 10, 0}}, 2, 600, 10);
  reach.memory = 1e9;
  EXPECT_EQ(answer(reach), "accepted");
  reach.memory = 1e8;
  EXPECT_THAT(answer(reach), HasSubstr("would have 242 neighbours, together 2.4e+06 bonds"));
  reach = reach_of(Box{{0, 0, 0}, {200000, 10, 10}}, 3, 600, 10);
  reach.memory = 1e8;
  EXPECT_THAT(answer(reach), HasSubstr("would have 484 neighbours"));
}

/// All bonds among 10 000 particles took 7.7 GB.
TEST(HorizonLimits, RefuseHorizonsLongerThanTheBody) {
  const Box square{{0, 0, 0}, {100, 100, 0}};
  EXPECT_THAT(answer(reach_of(square, 2, 142, 1)), HasSubstr("the body's diagonal is 141.421"));
  HorizonReach whole = reach_of(square, 2, 141, 1);
  whole.memory = 1e99;
  EXPECT_EQ(answer(whole), "accepted");
}

TEST(HorizonLimits, RefuseHorizonsFarBeyondTheBody) {
  // The body has 5 by 9 particles on 40 by 80: a diagonal of 89.
  for (const double ratio : {21.0, 200.0, 2e9, 1e12, 1e48}) {
    CaseFile input = strip_case();
    input.body.horizon.reset();
    input.body.horizon_ratio = ratio;
    test::expect_refused(input, "body.horizon_ratio", "the body's diagonal is 89.4427");
    test::expect_refused(input, "body.horizon_ratio", "bonded to every other");
  }
  CaseFile input = strip_case();
  for (const double horizon : {90.0, 175.0}) {  // to every other, yet no slip
    input.body.horizon = horizon;
    EXPECT_EQ(build_model(input).network.first_slip_spring, 45 * 44 / 2);
  }
}

TEST(HorizonLimits, RefuseBondsAlongRowsOnly) {
  CaseFile input = strip_case();
  for (const Surface surface : {Surface::none, Surface::calibrated}) {
    input.body.surface = surface;
    input.body.horizon = 14.1;
    test::expect_refused(input, "body.horizon", "at least horizon_ratio = 1.4143");
  }
  input.body.surface = Surface::none;
  input.body.horizon = 14.143;
  EXPECT_NO_THROW(build_model(input));
  input.body.horizon = 10.0;
  input.body.pattern = Pattern::hexagonal;  // its rows run along three directions
  input.body.horizon.reset();
  input.body.horizon_ratio = 1.0;
  EXPECT_NO_THROW(build_model(input));
}

/// Columns 10 apart within a horizon of 31: bending is too stiff by 0.8 / n^2 for bonds and by
/// 2.3 / n^2 for micropolar ones, with n steps across. Within a horizon of 20 the latter are too
/// stiff by 1.8 / n^2: bodies wider than one horizon each way count, too.
TEST(HorizonLimits, NoteThinBodies) {
  const auto note = [](double width, BodyModel kind, double horizon = 31.0) {
    CaseFile input = strip_case();
    input.body.horizon = horizon;
    for (Region& region : input.regions) region.box.upper[0] = width;
    input.body.model = kind;
    return thin_body_note(input, draft_model(input)).value_or("");
  };
  EXPECT_THAT(note(20.0, BodyModel::bond_based), AllOf(HasSubstr("along x"), HasSubstr("17 %")));
  EXPECT_THAT(note(20.0, BodyModel::micropolar), HasSubstr("36 %"));
  EXPECT_THAT(note(40.0, BodyModel::micropolar), AllOf(HasSubstr("40 wide"), HasSubstr("13 %")));
  EXPECT_EQ(note(40.0, BodyModel::bond_based), "");
  EXPECT_EQ(note(70.0, BodyModel::micropolar), "");
  EXPECT_THAT(note(30.0, BodyModel::micropolar, 20.0), HasSubstr("30 wide, 1.5 horizons"));
  EXPECT_THAT(note(30.0, BodyModel::bond_based, 20.0), HasSubstr("12 %"));
  for (const double horizon : {15.0, 20.0, 31.0, 40.0}) {
    EXPECT_EQ(note(70.0, BodyModel::micropolar, horizon), "") << horizon;
    EXPECT_EQ(note(50.0, BodyModel::bond_based, horizon), "") << horizon;
  }
}

}  // namespace
}  // namespace perilink
