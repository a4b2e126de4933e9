#include "app/run_doubts.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace perilink {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

ExplicitResult sound() {
  ExplicitResult result;
  result.peak_load = -100.0;
  result.largest_surplus = 1e-5;
  return result;
}

TEST(RunDoubts, AreNoneWhereEnergyAndForcesBalance) {
  EXPECT_THAT(doubts_about(sound(), 104.0), IsEmpty());
}

TEST(RunDoubts, NameEnergyThatIsTooMuch) {
  ExplicitResult result = sound();
  result.largest_surplus = 0.13;
  EXPECT_THAT(doubts_about(result, 100.0), ElementsAre(HasSubstr("up to 13 % of the work")));
}

TEST(RunDoubts, NameALoadThatTheSupportsDoNotFeel) {
  EXPECT_THAT(doubts_about(sound(), 107.0), ElementsAre(HasSubstr("differ by 7 %")));
  EXPECT_THAT(doubts_about(sound(), 94.0), ElementsAre(HasSubstr("differ by 6 %")));
}

TEST(RunDoubts, LeaveSupportsOfSymmetryAlone) {
  ExplicitResult result = sound();
  EXPECT_THAT(doubts_about(result, 500.0), IsEmpty());
  result.peak_load = 0.0;
  EXPECT_THAT(doubts_about(result, 0.0), IsEmpty());
  EXPECT_THAT(doubts_about(result, 50.0), IsEmpty());
}

TEST(RunDoubts, AreNoneWhereEquilibriaAreExactButForRoundOff) {
  DamageResult result;
  result.energy_error = result.largest_residual = 1e-9;
  EXPECT_THAT(doubts_about(result), IsEmpty());
}

TEST(RunDoubts, NameEnergiesAndForcesOutOfBalance) {
  DamageResult result;
  result.energy_error = 0.99;
  EXPECT_THAT(doubts_about(result), ElementsAre(HasSubstr("up to 0.99 of the work")));
  result.largest_residual = 3e-6;
  EXPECT_THAT(doubts_about(result),
              ElementsAre(HasSubstr("of the work"), HasSubstr("up to 3e-06 of the load")));
}

TEST(RunDoubts, NameWhatIsNotANumber) {
  DamageResult result;
  result.energy_error = NAN;
  EXPECT_THAT(doubts_about(result), ElementsAre(HasSubstr("out of balance")));
}

}  // namespace
}  // namespace perilink
