#include "app/run/summary.hpp"

#include "app/results/calibration_text.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "base/build_info.hpp"
#include "base/error.hpp"
#include "support/strip_case.hpp"
#include "support/temporary_directory.hpp"

namespace perilink {
namespace {

DamageResult some_result() {
  DamageResult result;
  result.ending = Ending::collapsed;
  result.reason = "the body \"separated\"";
  result.last.step = 9;
  result.last.yield_events = 2;
  result.last.external_work = 7.5;
  result.last.strain_energy = 3.0;
  result.last.dissipated_energy = 4.5;
  result.broken_bonds = 8;
  result.peak_load = 1.0 / 3.0;
  result.peak_displacement = 0.125;
  for (const CurvePoint row : {CurvePoint{0.0625, 0.25}, {0.09, 0.1}, {0.125, 1.0 / 3.0}}) {
    result.peaks.add(row);
  }
  result.smoothed_peak_load = 0.1875;
  result.places = {{"upper platen", {0.0, -0.25}}, {"lower platen", {0.0, 0.25}}};
  result.initial_stiffness = 64.0;
  result.largest_residual = 1e-14;
  result.energy_error = 2e-13;
  result.factor.factorizations = 2;
  result.factor.bytes = 1024.0;
  return result;
}

TEST(Summary, HoldsEveryFigureUnderItsKey) {
  const test::TemporaryDirectory work;
  const CaseFile input = test::strip_case();
  Model model = build_model(input);
  model.network.calibration.value().seconds = 0.125;
  model.notes = {"mind the gap"};
  write_summary(work.path(), input, model, some_result(), {0.25, 0.5, 0.75}, 3);
  const auto json = nlohmann::ordered_json::parse(test::read_text(work / "summary.json"));

  const nlohmann::ordered_json expected = {
      {"title", "A strip in tension"},
      {"units", "kip, in"},
      {"status", "collapsed"},
      {"reason", "the body \"separated\""},
      {"peak_load", 1.0 / 3.0},
      {"peak_displacement", 0.125},
      {"first_peak_load", 0.25},
      {"first_peak_displacement", 0.0625},
      {"smoothed_peak_load", 0.1875},
      {"places",
       {{{"name", "upper platen"}, {"force", {0.0, -0.25}}},
        {{"name", "lower platen"}, {"force", {0.0, 0.25}}}}},
      {"initial_stiffness", 64.0},
      {"steps", 9},
      {"broken_bonds", 8},
      {"yield_events", 2},
      {"external_work", 7.5},
      {"strain_energy", 3.0},
      {"dissipated_energy", 4.5},
      {"energy_error", 2e-13},
      {"largest_residual", 1e-14},
      {"doubts", nlohmann::json::array()},
      {"particles", 45},
      {"bonds", model.network.num_elements()},
      {"unknowns", 60},
      {"calibration", calibration_json(model.network.calibration.value())},
      {"spacing", 10.0},
      {"horizon", 31.0},
      {"notes", model.notes},
      {"factorizations", 2},
      {"factor_bytes", 1024.0},
      {"seconds", {{"set_up", 0.25}, {"analysis", 0.5}, {"output", 0.75}, {"calibration", 0.125}}},
      {"threads", 3},
      {"version", program_version()},
      {"commit", program_commit()}};
  for (const auto& [key, value] : expected.items()) {
    ASSERT_TRUE(json.contains(key)) << key;
    EXPECT_EQ(json[key], value) << key;
  }
  EXPECT_GT(json["peak_memory_bytes"].get<double>(), 1e6);
  EXPECT_EQ(json.size(), expected.size() + 1) << "a key that no test knows";
}

TEST(Summary, SplitsTheTimeOfAnElasticAnalysis) {
  const test::TemporaryDirectory work;
  const CaseFile input = test::strip_case();
  PhaseSeconds seconds{0.25, 0.5, 0.75};
  seconds.elastic = ElasticSeconds{0.125, 0.0625, 0.03125};
  Model model = build_model(input);
  model.network.calibration.emplace().seconds = 0.1875;
  write_summary(work.path(), input, model, some_result(), seconds, 3);
  const auto json = nlohmann::json::parse(test::read_text(work / "summary.json"));
  EXPECT_EQ(json["seconds"], (nlohmann::json{{"set_up", 0.25},
                                             {"calibration", 0.1875},
                                             {"analysis", 0.5},
                                             {"output", 0.75},
                                             {"assembly", 0.125},
                                             {"factorization", 0.0625},
                                             {"solve", 0.03125}}));
}

TEST(Summary, NamesEveryEnding) {
  const CaseFile input = test::strip_case();
  const Model model = build_model(input);
  for (const auto& [ending, word] :
       std::vector<std::pair<Ending, std::string>>{{Ending::completed, "completed"},
                                                   {Ending::collapsed, "collapsed"},
                                                   {Ending::nothing_breaks, "nothing_breaks"},
                                                   {Ending::interrupted, "interrupted"},
                                                   {Ending::failed, "failed"}}) {
    const test::TemporaryDirectory work;
    DamageResult result = some_result();
    result.ending = ending;
    write_summary(work.path(), input, model, result, {}, 1);
    EXPECT_EQ(nlohmann::json::parse(test::read_text(work / "summary.json"))["status"], word);
  }
}

/// The lower end is held, the upper one pulled by a force.
TEST(Summary, NotesBondsThatBreakAtParticlesWithPrescribedDisplacements) {
  const Model model = build_model(test::strip_case());
  const Bonds& bonds = model.network.bonds;
  std::vector<Index> at_grip, elsewhere;
  for (Index b = 0; b < bonds.size(); ++b) {
    const double lower = std::min(model.network.particles.position(bonds.first[b])[1],
                                  model.network.particles.position(bonds.second[b])[1]);
    (lower <= 20.0 ? at_grip : elsewhere).push_back(b);
  }
  EXPECT_EQ(note_of_grips(model, {}), std::nullopt);
  EXPECT_EQ(note_of_grips(model, elsewhere), std::nullopt);
  const std::vector<Index> broken = {elsewhere[0], at_grip[0], elsewhere[1], at_grip[1]};
  EXPECT_THAT(note_of_grips(model, broken).value(),
              testing::HasSubstr("2 of 4 broken bonds end at particles of [[supports]]"));
}

TEST(Summary, LeavesOutAReactionWhereSupportsBearNothing) {
  EXPECT_EQ(reaction_text(0.0), "");
  EXPECT_EQ(reaction_text(-12.5), ", reaction of supports -12.5");
}

TEST(Summary, AFailureToWriteIsReported) {
  const CaseFile input = test::strip_case();
  EXPECT_THROW(write_summary("/no/such/folder", input, build_model(input), {}, {}, 1), FileError);
}

TEST(Summary, ForPeopleSaysHowItEndedAndWhereTheResultsAre) {
  const CaseFile input = test::strip_case();
  Model model = build_model(input);
  model.notes.push_back("mind the gap");
  DamageResult result = some_result();
  result.energy_error = 0.5;
  testing::internal::CaptureStdout();
  print_summary(input, model, result, {0.25, 0.5, 0.75}, "results/strip");
  const std::string text = testing::internal::GetCapturedStdout();
  for (const char* part :
       {"A strip in tension", "collapsed", "0.333333 at displacement 0.125", "[kip, in]",
        "8 broken bonds, 2 yield events, 9 rows", "45 particles", "0.1875 of the smooth curve",
        "(0, -0.25) by upper platen", "mind the gap", "up to 0.5 of the work", "results/strip"}) {
    EXPECT_THAT(text, testing::HasSubstr(part));
  }
}

}  // namespace
}  // namespace perilink
