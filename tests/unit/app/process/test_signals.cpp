#include "app/process/signals.hpp"

#include <gtest/gtest.h>

#include <csignal>
#include <cstdlib>

namespace perilink {
namespace {

// Each runs in a process of its own, since a signal is remembered for good.

[[noreturn]] void catch_and_report(int signal) {
  if (stop_signal_received()) std::exit(1);
  catch_stop_signals();
  if (stop_signal_received()) std::exit(2);
  std::raise(signal);
  std::exit(stop_signal_received() ? 0 : 3);
}

class SignalsDeathTest : public testing::Test {
 protected:
  // Forking is unsafe in a process with threads, which other tests may have started.
  SignalsDeathTest() { GTEST_FLAG_SET(death_test_style, "threadsafe"); }
};

TEST_F(SignalsDeathTest, InterruptAndTerminateAreRemembered) {
  EXPECT_EXIT(catch_and_report(SIGINT), testing::ExitedWithCode(0), "");
  EXPECT_EXIT(catch_and_report(SIGTERM), testing::ExitedWithCode(0), "");
  EXPECT_EXIT(catch_and_report(SIGHUP), testing::ExitedWithCode(0), "");
}

/// Both system and shell may report that the terminal is gone.
TEST_F(SignalsDeathTest, TerminalsMayBeClosedTwice) {
  EXPECT_EXIT(
      {
        catch_stop_signals();
        std::raise(SIGHUP);
        std::raise(SIGHUP);
        std::exit(stop_signal_received() ? 0 : 1);
      },
      testing::ExitedWithCode(0), "");
}

/// As under nohup.
TEST_F(SignalsDeathTest, IgnoredSignalsStayIgnored) {
  EXPECT_EXIT(
      {
        std::signal(SIGHUP, SIG_IGN);
        catch_stop_signals();
        std::raise(SIGHUP);
        std::exit(stop_signal_received() ? 1 : 0);
      },
      testing::ExitedWithCode(0), "");
}

TEST_F(SignalsDeathTest, ASecondSignalEndsTheProgram) {
  for (const int signal : {SIGINT, SIGTERM}) {
    EXPECT_EXIT(
        {
          catch_stop_signals();
          std::raise(signal);
          std::raise(signal);
          std::exit(0);
        },
        testing::KilledBySignal(signal), "");
  }
}

}  // namespace
}  // namespace perilink
