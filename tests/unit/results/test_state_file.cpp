#include "results/state_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "analysis/quasistatic/event_run.hpp"
#include "base/error.hpp"
#include "base/files.hpp"
#include "io/checkpoint/pack.hpp"
#include "model/from_case/configure.hpp"
#include "support/strip_case.hpp"
#include "support/temporary_directory.hpp"

namespace perilink {
namespace {

class StateFile : public testing::Test {
 protected:
  /// Advances a run by some rows.
  static void advance(EventRun& run, int rows) {
    for (int k = 0; k < rows; ++k) ASSERT_NE(run.next(), nullptr);
  }
  std::string refusal(const LoadedNetwork& problem) const {
    try {
      read_state(path_, problem);
    } catch (const FileError& error) {
      return error.what();
    }
    return "";
  }

  test::TemporaryDirectory work_;
  const std::string path_ = (work_ / "state.bin").string();
  CaseFile input_ = test::strip_case();
  const Model model_ = build_model(input_);
  const DamageOptions options_ = damage_options(input_, 1);
};

TEST_F(StateFile, GivesBackTheState) {
  EventRun run(model_, options_);
  advance(run, 3);
  const DamageState state = run.save();
  write_state(path_, model_, state);
  EXPECT_EQ(pack(read_state(path_, model_)), pack(state));
  EventRun first(model_, options_, state), second(model_, options_, read_state(path_, model_));
  while (const StepRecord* row = first.next()) {
    const StepRecord* again = second.next();
    ASSERT_NE(again, nullptr);
    EXPECT_EQ(again->load, row->load);
    EXPECT_EQ(again->element, row->element);
  }
  EXPECT_EQ(second.next(), nullptr);
  EXPECT_EQ(first.result().broken_bonds, second.result().broken_bonds);
}

TEST_F(StateFile, OfAnotherProblemIsRefused) {
  EXPECT_THAT(refusal(model_), testing::HasSubstr("there is no such file"));
  EventRun run(model_, options_);
  advance(run, 1);
  write_state(path_, model_, run.save());
  input_.loads[0].force = Vector3{0.0, 13.0, 0.0};
  EXPECT_THAT(refusal(build_model(input_)), testing::HasSubstr("of another problem"));
  input_ = test::strip_case();
  input_.materials[0].youngs_modulus = 3001.0;
  EXPECT_THAT(refusal(build_model(input_)), testing::HasSubstr("of another problem"));
  write_whole_file(path_, "something else");
  EXPECT_THAT(refusal(model_), testing::HasSubstr("is no checkpoint"));
}

}  // namespace
}  // namespace perilink
