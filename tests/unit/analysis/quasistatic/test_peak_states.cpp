#include "analysis/quasistatic/peak_states.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace perilink {
namespace {

using testing::ElementsAre;
using testing::ElementsAreArray;

/// Four elements that lose stiffness as a test says; the displacement is the number of the row.
class PeakStatesTest : public testing::Test, protected StateSource {
 protected:
  StepState state() override {
    ++solves_;
    return unsolved_state();
  }
  StepState unsolved_state() override {
    ++looks_;
    displacement_.assign(3, static_cast<double>(record_.step));
    return {network_, Secants(secants_, axial_), displacement_, whole_};
  }
  /// A row with a load, at which elements fail.
  void row(double load, std::vector<Index> failing = {}, bool by_events = true) {
    ++record_.step;
    record_.load = load;
    record_.displacement = 0.1 * record_.step;
    record_.element = failing.empty() ? no_index : failing.front();
    record_.others.assign(failing.empty() ? failing.end() : failing.begin() + 1, failing.end());
    peaks_.add(record_, *this, by_events);
    for (const Index e : failing) secants_[e] = axial_[e] = 0.5 * secants_[e];
  }
  const PeakStates::State* at(Index step, double load) const {
    return peaks_.find({0.1 * step, load});
  }
  std::vector<double> secants_at(Index step, double load) const {
    return peaks_.ratios(*at(step, load), 4).secants;
  }

  Network network_;
  std::vector<double> secants_ = {1.0, 1.0, 1.0, 0.0}, axial_ = secants_, displacement_;
  std::vector<std::uint8_t> whole_ = {1, 0};
  StepRecord record_;
  PeakStates peaks_;
  int solves_ = 0, looks_ = 0;
};

TEST_F(PeakStatesTest, KeepsTheStateOfTheLargestLoad) {
  row(1.0, {2});
  row(-3.0, {0, 1});
  row(2.0, {2});
  ASSERT_NE(at(2, 3.0), nullptr) << "the sign of a load does not count";
  EXPECT_EQ(at(2, 3.0), peaks_.highest());
  EXPECT_EQ(at(3, 2.0), nullptr);
  EXPECT_EQ(at(1, 1.0), nullptr) << "the load has not fallen before the next row";
  EXPECT_THAT(at(2, 3.0)->displacement, ElementsAre(2.0, 2.0, 2.0));
  EXPECT_THAT(at(2, 3.0)->whole, ElementsAreArray(whole_));
  EXPECT_THAT(secants_at(2, 3.0), ElementsAre(1.0, 1.0, 0.5, 0.0));
  EXPECT_EQ(solves_, 0);
  EXPECT_EQ(looks_, 2) << "rows below the largest load need no state";
}

TEST_F(PeakStatesTest, KeepsAFirstPeakBehindWhichTheLoadFell) {
  row(3.0, {0});
  row(1.0, {1});
  row(4.0, {2});
  row(5.0);
  ASSERT_NE(at(1, 3.0), nullptr);
  EXPECT_THAT(secants_at(1, 3.0), ElementsAre(1.0, 1.0, 1.0, 0.0));
  EXPECT_THAT(secants_at(4, 5.0), ElementsAre(0.5, 0.5, 0.5, 0.0));
  EXPECT_EQ(at(3, 4.0), nullptr);
}

/// The peaks 10, 20, ... leave 54 %, 58 %, ... of their loads.
TEST_F(PeakStatesTest, DropsTheShallowestOfManyFalls) {
  for (int k = 1; k <= 10; ++k) {
    row(10.0 * k);
    row(10.0 * k * (0.5 + 0.04 * k));
  }
  for (int k = 1; k <= 10; ++k) {
    const bool dropped = k == 8 || k == 9;  // the newest has not fallen before a larger one came
    EXPECT_EQ(at(2 * k - 1, 10.0 * k) == nullptr, dropped) << k;
  }
}

TEST_F(PeakStatesTest, LoadStepsNameNoElements) {
  row(1.0, {}, false);
  secants_[1] = axial_[1] = 0.25;
  secants_[2] = 0.5;  // closed: the axial stiffness is intact
  row(2.0, {}, false);
  EXPECT_THAT(secants_at(2, 2.0), ElementsAre(1.0, 0.25, 0.5, 0.0));
  EXPECT_THAT(peaks_.ratios(*peaks_.highest(), 4).axial, ElementsAre(1.0, 0.25, 1.0, 0.0));
}

TEST_F(PeakStatesTest, ALoadCaseForgetsTheLast) {
  row(3.0, {1});
  peaks_.clear();
  EXPECT_EQ(peaks_.highest(), nullptr);
  row(1.0);
  EXPECT_THAT(secants_at(2, 1.0), ElementsAre(1.0, 0.5, 1.0, 0.0));
}

}  // namespace
}  // namespace perilink
