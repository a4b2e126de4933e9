#include "app/run/summary.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/strip_case.hpp"
#include "support/temporary_directory.hpp"

namespace perilink {
namespace {

using testing::HasSubstr;
using testing::Not;

TEST(Summary, LeavesOutAReactionWhereSupportsBearNothing) {
  PeakWatch peaks;
  peaks.add({0.125, 1.0});
  const auto line = [&](std::optional<double> reaction) {
    Summary summary;
    tell_peaks(summary, {}, peaks, reaction);
    EXPECT_EQ(summary.json.contains("peak_reaction"), reaction.has_value());
    return summary.text;
  };
  EXPECT_EQ(line({}), "  peak load      1 at displacement 0.125\n");
  EXPECT_EQ(line(0.0), line({}));
  EXPECT_THAT(line(-12.5), HasSubstr(", reaction of supports -12.5"));
}

TEST(Summary, KeepsTheFirstPlaceOfAKey) {
  Summary summary;
  summary.add("a", 1);
  summary.add("b", 2);
  summary.add("a", 3);
  EXPECT_EQ(summary.json.dump(), R"({"a":3,"b":2})");
}

TEST(Summary, TellsWhatOnlySomeMovingBodiesHave) {
  CaseFile input;
  input.analysis.type = AnalysisType::explicit_;
  input.body.model = BodyModel::lattice;
  const test::TemporaryDirectory work;
  const RunFiles files(input, work.path(), true);
  ExplicitResult result;
  result.last.cracked_particles = 3;
  result.last.yielded_particles = 2;
  result.last.energy.plastic = 0.5;
  result.last.energy.fractured = 0.25;
  Summary plain, flowing;
  tell_motion(plain, input, files, result, {});
  EXPECT_THAT(plain.text, HasSubstr("dissipated by 3 cracked particles, balance"));
  for (const char* key : {"yielded_particles", "fundamental_period", "constants"}) {
    EXPECT_FALSE(plain.json.contains(key)) << key;
  }
  tell_motion(flowing, input, files, result, {4.0, true, {{"exact", 7}}});
  EXPECT_THAT(flowing.text, HasSubstr("3 cracked particles, 0.5 by 2 yielded ones, balance"));
  EXPECT_EQ(flowing.json["yielded_particles"], 2);
  EXPECT_EQ(flowing.json["plastic_energy"], 0.5);
  EXPECT_EQ(flowing.json["dissipated_energy"], 0.75);
  EXPECT_EQ(flowing.json["fundamental_period"], 4.0);
  EXPECT_EQ(flowing.json["constants"]["exact"], 7);
}

TEST(Summary, TellsTheSizesOfABody) {
  const Model model = build_model(test::strip_case());
  Summary summary;
  tell_body(summary, model, ", and more");
  EXPECT_EQ(summary.json["particles"], 45);
  EXPECT_EQ(summary.json["unknowns"], 60);
  EXPECT_FALSE(summary.json.contains("cells"));
  EXPECT_THAT(summary.text, HasSubstr(size_text(model) + ", and more"));
}

/// Two bonds in a row and one apart.
TEST(Summary, TellsTheLargestCracks) {
  const Model model = build_model(test::strip_case());
  CrackOpenings openings;
  openings.bonds = {3, 5, 9};
  openings.opening = {0.1, 0.3, 0.7};
  openings.cracks = {summed_up(openings, std::array<std::size_t, 2>{0, 1}),
                     summed_up(openings, std::array<std::size_t, 1>{2})};
  const std::vector<ToldCrack> told = widest_cracks(model.network, openings);
  ASSERT_EQ(told.size(), 2u);
  Summary summary;
  tell_cracks(summary, told);
  EXPECT_EQ(summary.json["cracks"][0]["bonds"], 2);
  EXPECT_DOUBLE_EQ(summary.json["cracks"][0]["mean_opening"], 0.2);
  EXPECT_EQ(summary.json["cracks"][0]["largest_opening"], 0.3);
  const Bonds& bonds = model.network.bonds;
  const double x = 0.5 * (model.network.particles.position(bonds.first[5])[0] +
                          model.network.particles.position(bonds.second[5])[0]);
  EXPECT_DOUBLE_EQ(summary.json["cracks"][0]["widest_at"][0], x);
  EXPECT_THAT(summary.text,
              HasSubstr("the largest has 2 damaged bonds and a largest opening of 0.3"));
  Summary none;
  tell_cracks(none, {});
  EXPECT_TRUE(none.text.empty());
}

TEST(Summary, KnowsTheMemoryOfTheProcess) { EXPECT_GT(peak_memory_bytes(), 1e6); }

}  // namespace
}  // namespace perilink
