#include "app/run/run_notes.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "support/strip_case.hpp"

namespace perilink {
namespace {

using testing::HasSubstr;
using testing::Not;

DamageResult result_of(const std::vector<CurvePoint>& rows) {
  DamageResult result;
  for (const CurvePoint& row : rows) result.peaks.add(row);
  return result;
}

TEST(PeakWarning, SaysBothPeaksOfALoadThatClimbedAgain) {
  const PeakWatch peaks = result_of({{0.1, 3320}, {0.2, 900}, {5.0, 11314}}).peaks;
  const auto warning = text_of_peaks(peaks, false);
  ASSERT_TRUE(warning);
  EXPECT_THAT(
      *warning,
      HasSubstr("residual strength: the load reached 3320 at displacement 0.1 (peak_load), it "
                "fell or a crack separated the body, and the load rose again to 11314 at 5 "
                "(largest_load)"));
  EXPECT_THAT(text_of_peaks(peaks, true).value(),
              testing::AllOf(HasSubstr("reached 3320 at displacement 0.1 (first_peak_load)"),
                             HasSubstr("rose again to 11314 at 5 (peak_load)")));
}

TEST(PeakWarning, IsSilentWhereTheFirstPeakIsTheHighest) {
  EXPECT_FALSE(text_of_peaks(result_of({{0.1, 3320}, {0.2, 900}, {5.0, 3319}}).peaks, false));
  EXPECT_FALSE(text_of_peaks(result_of({{0.1, 3320}, {0.2, 1700}, {5.0, 11314}}).peaks, false))
      << "it never fell below half";
}

/// A strip whose lower end is held and whose upper one is pulled by a force.
struct HeldStrip {
  HeldStrip() {
    const Bonds& bonds = model.network.bonds;
    for (Index b = 0; b < bonds.size(); ++b) {
      const double lower = std::min(model.network.particles.position(bonds.first[b])[1],
                                    model.network.particles.position(bonds.second[b])[1]);
      (lower <= 20.0 ? at_clamp : elsewhere).push_back(b);
    }
  }
  Model model = build_model(test::strip_case());
  std::vector<Index> at_clamp, elsewhere;
};

TEST(ClampNote, CountsBondsThatBreakAtParticlesWithPrescribedDisplacements) {
  const auto [model, at_clamp, elsewhere] = HeldStrip();
  EXPECT_EQ(note_of_clamps(model, {}), std::nullopt);
  EXPECT_EQ(note_of_clamps(model, elsewhere), std::nullopt);
  const std::vector<Index> broken = {elsewhere[0], at_clamp[0], elsewhere[1], at_clamp[1]};
  EXPECT_THAT(note_of_clamps(model, broken).value(),
              HasSubstr("2 of 4 broken bonds end at particles of [[supports]]"));
}

/// Only bonds that broke after failure of the body count.
TEST(PeakWarning, CountsLaterBondsAtGrips) {
  const auto [model, at_clamp, elsewhere] = HeldStrip();
  DamageResult result = result_of({{0.1, 3320}, {0.2, 900}, {5.0, 11314}});
  result.broken_as_gave_way = 2;
  const std::vector<Index> torn = {at_clamp[0], elsewhere[0], at_clamp[1], at_clamp[2],
                                   elsewhere[1]};
  EXPECT_THAT(
      text_of_peaks(result, model, torn).value(),
      HasSubstr(
          "2 of the 3 bonds that broke after the first peak end at particles of [[supports]]"));
  const std::vector<Index> sound = {at_clamp[0], at_clamp[1], elsewhere[0]};
  EXPECT_THAT(text_of_peaks(result, model, sound).value(), Not(HasSubstr("supports")));
  EXPECT_FALSE(text_of_peaks(result_of({{0.1, 3320}}), model, torn));
}

}  // namespace
}  // namespace perilink
