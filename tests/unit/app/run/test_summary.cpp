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

TEST(Summary, TellsTheTenWidestCracks) {
  std::vector<GrownCrack> cracks(12,
                                 {3, {4.0, 5.0}, {1.0, 0.0}, 0.5, 0.1, 0.2, {4.0, 5.0}, {}, {}});
  cracks[0] = {12, {1.0, 2.0}, {0.0, 1.0}, 3.5, 0.25, 0.5, {1.5, 2.5}, 0.375, 1, 0.125};
  Summary summary;
  tell_cracks(summary, cracks);
  EXPECT_EQ(summary.json["cracks"].size(), 10u);
  const auto& widest = summary.json["cracks"][0];
  EXPECT_EQ(widest["bonds"], 12);
  EXPECT_EQ(widest["length"], 3.5);
  EXPECT_EQ(widest["largest_opening"], 0.5);
  EXPECT_EQ(widest["widest_at"], (std::vector<double>{1.5, 2.5}));
  EXPECT_EQ(widest["face_opening"], 0.375);
  EXPECT_EQ(widest["bar"], 2);
  EXPECT_EQ(widest["bar_opening"], 0.125);
  EXPECT_FALSE(summary.json["cracks"][1].contains("bar"));
  EXPECT_THAT(summary.text, HasSubstr("12; the widest is 3.5 long, its opening 0.5 at (1.5, 2.5), "
                                      "0.375 at the face, 0.125 at bar 2"));
  Summary none;
  tell_cracks(none, {});
  EXPECT_TRUE(none.text.empty());
}

TEST(Summary, KnowsTheMemoryOfTheProcess) { EXPECT_GT(peak_memory_bytes(), 1e6); }

}  // namespace
}  // namespace perilink
