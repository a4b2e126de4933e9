#include "app/run/lattice_summary.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "base/error.hpp"
#include "support/program_cases.hpp"
#include "support/temporary_directory.hpp"

namespace perilink {
namespace {

using testing::HasSubstr;

class ExplicitSummaryTest : public testing::Test {
 protected:
  ExplicitSummaryTest()
      : input_(parse_case(test::lattice_bar_case(), "")),
        built_(build_explicit_case(input_)),
        observer_(input_, built_, work_.path(), true) {
    ExplicitState state(built_.model);
    result_ = run_explicit_analysis(built_.model, state, built_.options, observer_);
    seconds_.analysis = 2.0;
  }
  ExplicitSummary summary() const { return {input_, built_, result_, observer_, seconds_, 3}; }

  test::TemporaryDirectory work_;
  CaseFile input_;
  ExplicitCase built_;
  ExplicitRunObserver observer_;
  ExplicitResult result_;
  PhaseSeconds seconds_;
};

TEST_F(ExplicitSummaryTest, TellsTheRun) {
  write_summary(work_.path(), summary());
  std::ifstream file(work_ / "summary.json");
  const nlohmann::json json = nlohmann::json::parse(file);
  EXPECT_EQ(json["status"], "completed");
  EXPECT_EQ(json["steps"], built_.steps);
  EXPECT_EQ(json["rows"], observer_.rows());
  EXPECT_EQ(json["particles"], built_.model.lattice.particles());
  EXPECT_EQ(json["bonds"], built_.bonds);
  EXPECT_EQ(json["time_step"], built_.time_step);
  EXPECT_EQ(json["critical_time_step"], built_.critical_time_step);
  EXPECT_EQ(json["peak_load"], observer_.peaks().highest().load);
  EXPECT_EQ(json["first_peak_load"], observer_.peaks().first().load);
  EXPECT_EQ(json["peak_reaction"], result_.peak_load);
  EXPECT_EQ(json["energy_error"], result_.largest_surplus);
  EXPECT_EQ(json["threads"], 3);
  const double steps = static_cast<double>(built_.steps) * built_.model.lattice.particles();
  EXPECT_EQ(json["particle_steps_per_second"], 0.5 * steps);
  const double work = json["external_work"];
  EXPECT_GT(work, 0.0);
  EXPECT_NEAR(json["kinetic_energy"].get<double>() + json["strain_energy"].get<double>() +
                  json["damped_energy"].get<double>() + json["dissipated_energy"].get<double>(),
              work, json["energy_error"].get<double>() * work * 1.001);
}

TEST_F(ExplicitSummaryTest, IsPrintedForPeople) {
  testing::internal::CaptureStdout();
  print_summary("results/bar", summary());
  const std::string text = testing::internal::GetCapturedStdout();
  for (const char* part : {"completed", "peak load", "particle-steps/s", "balance to",
                           "216 particles", "results/bar"}) {
    EXPECT_THAT(text, HasSubstr(part));
  }
}

TEST_F(ExplicitSummaryTest, OfADirectoryThatIsNotThereIsRefused) {
  EXPECT_THROW(write_summary(work_ / "nowhere", summary()), FileError);
}

TEST_F(ExplicitSummaryTest, OfNoTimeHasNoRate) {
  seconds_.analysis = 0.0;
  EXPECT_EQ(summary().particle_steps_per_second(), 0.0);
}

}  // namespace
}  // namespace perilink
