#include "analysis/quasistatic/observer.hpp"

#include <gtest/gtest.h>

namespace perilink {
namespace {

/// The words of summary.json; scripts of users rely on them.
TEST(Termination, HasAWordForEveryKind) {
  EXPECT_EQ(to_string(Termination::completed), "completed");
  EXPECT_EQ(to_string(Termination::collapsed), "collapsed");
  EXPECT_EQ(to_string(Termination::nothing_breaks), "nothing_breaks");
  EXPECT_EQ(to_string(Termination::interrupted), "interrupted");
  EXPECT_EQ(to_string(Termination::failed), "failed");
}

/// An observer of rows needs only on_step.
class Counter final : public StepObserver {
 public:
  void on_step(const StepRecord&, StateSource&) override { ++rows; }
  int rows = 0;
};

class NoState final : public StateSource {
 public:
  StepState state() override {
    ADD_FAILURE() << "the state was not requested";
    return {network_, {}, {}};
  }

 private:
  Network network_;
};

TEST(StepObserver, ByDefaultNeitherStopsNorAsksForTheState) {
  Counter counter;
  NoState source;
  counter.on_step({}, source);
  counter.on_end({}, source);
  EXPECT_FALSE(counter.stop_requested());
  EXPECT_EQ(counter.rows, 1);
}

}  // namespace
}  // namespace perilink
