#include "base/thread_choice.hpp"

#include <gtest/gtest.h>

namespace perilink {
namespace {

/// Pieces of work, of `count`, that are done by several threads.
int by_several(ThreadChoice& choice, int count, double with_one, double with_several) {
  int several = 0;
  for (int k = 0; k < count; ++k) {
    const bool with_all = choice.threads() > 1;
    several += with_all ? 1 : 0;
    choice.took(with_all ? with_several : with_one);
  }
  return several;
}

TEST(ThreadChoice, KeepsToWhatIsFaster) {
  ThreadChoice choice(4);
  EXPECT_EQ(choice.threads(), 1);
  EXPECT_GT(by_several(choice, 10000, 1.0, 0.6), 9900);
  ThreadChoice other(4);
  EXPECT_LT(by_several(other, 10000, 1.0, 7.0), 100);
}

TEST(ThreadChoice, FollowsTheMachine) {
  ThreadChoice choice(2);
  by_several(choice, 1000, 1.0, 0.6);
  EXPECT_LT(by_several(choice, 1000, 1.0, 7.0), 60);     // another program begins
  EXPECT_GT(by_several(choice, 10000, 1.0, 0.6), 8800);  // it ends
}

TEST(ThreadChoice, FollowsTheWork) {
  ThreadChoice choice(2);
  by_several(choice, 1000, 1.0, 0.6);
  EXPECT_GT(by_several(choice, 1000, 10.0, 6.0), 900);  // all of it grows
}

TEST(ThreadChoice, TrialsCostLittle) {
  ThreadChoice choice(2);
  double all = 0.0;
  for (int k = 0; k < 1000; ++k) {
    const double seconds = choice.threads() > 1 ? 75.0 : 1.0;
    all += seconds;
    choice.took(seconds);
  }
  EXPECT_LT(all, 1.2 * 1000);
}

TEST(ThreadChoice, ForgetsWhatComesOnce) {
  ThreadChoice choice(2);
  int several = 0;
  for (int k = 0; k < 10000; ++k) {
    const bool with_all = choice.threads() > 1;
    several += with_all ? 1 : 0;
    choice.took((with_all ? 0.6 : 1.0) * (k % 100 == 0 ? 50.0 : 1.0));
  }
  EXPECT_GT(several, 7000);
}

TEST(ThreadChoice, OneThreadIsNoChoice) {
  ThreadChoice choice(1);
  int threads = 0;
  choice.run([&](int number) { threads = number; });
  EXPECT_EQ(threads, 1);
}

TEST(ThreadChoice, RunsWhatItIsGiven) {
  ThreadChoice choice(3);
  int calls = 0;
  for (int k = 0; k < 20; ++k) {
    choice.run([&](int number) {
      EXPECT_TRUE(number == 1 || number == 3);
      ++calls;
    });
  }
  EXPECT_EQ(calls, 20);
}

}  // namespace
}  // namespace perilink
