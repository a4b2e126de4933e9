#include "app/run/run_kind.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/build_info.hpp"
#include "support/program_cases.hpp"
#include "support/strip_case.hpp"
#include "support/whole_run.hpp"

namespace perilink {
namespace {

using testing::HasSubstr;

/// A run that only ends.
class Stub final : public RunKind {
 public:
  using RunKind::RunKind;
  void analyse() override {}
  RunOutcome run_outcome() override { return {termination, reason}; }
  void tell(Summary& summary) const override {
    summary.add("own", 1.5);
    summary.line("own", "{} of its own", 1.5);
    summary.add_note("known late");
    summary.warnings = {"a doubt"};
    summary.rate = "7 per s";
  }
  Termination termination = Termination::collapsed;
  std::string reason = "the body \"separated\"";
};

TEST(RunKind, StandsInTheFrameOfAllSummaries) {
  const CaseFile input = test::strip_case();
  Stub run(input, 3);
  run.notes = {"known early"};
  run.seconds = {0.25, 0.5, 0.75, {{"solve", 0.125}}};
  const Summary summary = summary_of(run, "results/strip");
  const nlohmann::ordered_json expected = {
      {"title", "A strip in tension"},
      {"units", "kip, in"},
      {"analysis", "damage"},
      {"model", "bond_based"},
      {"status", "collapsed"},
      {"reason", "the body \"separated\""},
      {"own", 1.5},
      {"notes", {"known early", "known late"}},
      {"warnings", {"a doubt"}},
      {"seconds", {{"set_up", 0.25}, {"analysis", 0.5}, {"output", 0.75}, {"solve", 0.125}}},
      {"peak_memory_bytes", summary.json["peak_memory_bytes"]},
      {"threads", 3},
      {"version", program_version()},
      {"commit", program_commit()}};
  EXPECT_EQ(summary.json.dump(2), expected.dump(2));
  EXPECT_EQ(summary.text,
            "A strip in tension\n"
            "  ended          collapsed (the body \"separated\")\n"
            "  own            1.5 of its own\n"
            "  time           set-up 0.25 s, analysis 0.50 s (7 per s), output 0.75 s\n"
            "  note           known early\n"
            "  note           known late\n"
            "  warning        a doubt\n"
            "  results        results/strip\n");
}

TEST(RunKind, NamesEveryEnding) {
  const CaseFile input = test::strip_case();
  Stub run(input, 1);
  for (const auto& [termination, word] : std::vector<std::pair<Termination, std::string>>{
           {Termination::completed, "completed"},
           {Termination::collapsed, "collapsed"},
           {Termination::nothing_breaks, "nothing_breaks"},
           {Termination::interrupted, "interrupted"},
           {Termination::failed, "failed"}}) {
    run.termination = termination;
    EXPECT_EQ(summary_of(run, "").json["status"], word);
  }
}

/// One case of each kind of make_run().
std::vector<CaseFile> cases_of_all_kinds() {
  std::vector<CaseFile> cases(4, test::strip_case());
  cases[0].stop.broken_bonds = 3;
  cases[1].analysis.type = AnalysisType::elastic;
  cases[2].analysis.type = AnalysisType::relaxation;
  cases[2].analysis.load_factors = {0.01};
  cases[2].analysis.tolerance = 1e-2;
  cases[3].analysis.type = AnalysisType::explicit_;
  cases[3].analysis.duration = 1e-3;
  cases[3].analysis.rows = 2;
  cases[3].materials[0].density = 1.0;
  cases.push_back(parse_case(test::lattice_bar_case(), ""));
  return cases;
}

/// Values added by the frame are in the summaries of all kinds, under their key and in print.
TEST(RunKind, QuantitiesOfTheFrameAreThoseOfAllKinds) {
  for (const CaseFile& input : cases_of_all_kinds()) {
    const test::WholeRun run(input);
    const nlohmann::ordered_json& json = run.summary.json;
    const std::string kind =
        std::string(word_of(input.analysis.type)) + " " + std::string(word_of(input.body.model));
    EXPECT_EQ(json["analysis"], word_of(input.analysis.type));
    EXPECT_EQ(json["model"], word_of(input.body.model));
    for (const char* key : {"title",
                            "units",
                            "status",
                            "reason",
                            "peak_load",
                            "peak_displacement",
                            "first_peak_load",
                            "first_peak_displacement",
                            "largest_load",
                            "external_work",
                            "strain_energy",
                            "dissipated_energy",
                            "particles",
                            "bonds",
                            "spacing",
                            "notes",
                            "warnings",
                            "seconds",
                            "peak_memory_bytes",
                            "threads",
                            "version",
                            "commit"}) {
      EXPECT_TRUE(json.contains(key)) << kind << ": " << key;
    }
    for (const char* label :
         {"  ended  ", "load  ", "  energy  ", "  size  ", "  time  ", "  results  "}) {
      EXPECT_THAT(run.summary.text, HasSubstr(label)) << kind;
    }
    EXPECT_THAT(run.summary.text,
                HasSubstr(fmt::format(
                    "{:<17}{:.6g} at displacement {:.6g}",
                    input.analysis.type == AnalysisType::elastic ? "  load" : "  peak load",
                    json["peak_load"].get<double>(), json["peak_displacement"].get<double>())))
        << kind;
    EXPECT_THAT(run.summary.text,
                HasSubstr(fmt::format("{} particles", json["particles"].get<Index>())));
    EXPECT_FALSE(run.summary.outcome.empty()) << kind;
    EXPECT_FALSE(run.run->plan.empty()) << kind;
    EXPECT_EQ(run.history().columns, history_columns(run.input)) << kind;
    EXPECT_EQ(run.run->files().rows(), static_cast<Index>(run.history().rows.size())) << kind;
    EXPECT_FALSE(run.series().empty()) << kind;
  }
}

}  // namespace
}  // namespace perilink
