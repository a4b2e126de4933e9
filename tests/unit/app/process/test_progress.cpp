#include "app/process/progress.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <cstdlib>
#include <functional>
#include <string>

namespace perilink {
namespace {

TEST(Progress, DurationsAreRoundedBeforeTheyAreSplit) {
  EXPECT_EQ(format_duration(-1.0), "0 s");
  EXPECT_EQ(format_duration(0.0), "0 s");
  EXPECT_EQ(format_duration(3.4), "3 s");
  EXPECT_EQ(format_duration(59.4), "59 s");
  EXPECT_EQ(format_duration(59.6), "1 min 00 s");
  EXPECT_EQ(format_duration(130.0), "2 min 10 s");
  EXPECT_EQ(format_duration(3599.6), "1 h 00 min");
  EXPECT_EQ(format_duration(3900.0), "1 h 05 min");
  EXPECT_EQ(format_duration(100.0 * 3600.0), "100 h 00 min");
}

TEST(Progress, SaysNothingInItsFirstSecondsNorWhenQuiet) {
  testing::internal::CaptureStderr();
  for (const bool quiet : {true, false}) {
    ProgressBar bar(quiet);
    for (int k = 0; k < 100; ++k) EXPECT_FALSE(bar.is_due());
    bar.finish();
    bar.finish();
  }
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

/// Returns the output of an action on a standard error that is a terminal.
std::string on_terminal(const std::function<void()>& action) {
  const int master = posix_openpt(O_RDWR | O_NOCTTY);
  if (master < 0 || grantpt(master) != 0 || unlockpt(master) != 0) return "no terminal to be had";
  const int terminal = open(ptsname(master), O_RDWR | O_NOCTTY);
  const int standard_error = dup(STDERR_FILENO);
  dup2(terminal, STDERR_FILENO);
  action();
  dup2(standard_error, STDERR_FILENO);
  close(standard_error);
  // The terminal is still open: what it holds can be read, and no more is waited for.
  fcntl(master, F_SETFL, O_NONBLOCK);
  std::array<char, 4096> part{};
  std::string text;
  for (ssize_t size; (size = read(master, part.data(), part.size())) > 0;) {
    text.append(part.data(), static_cast<std::size_t>(size));
  }
  close(terminal);
  close(master);
  return text;
}

TEST(Progress, OfACalibrationIsALineThatIsGoneAtTheEnd) {
  const auto calibrate = [](bool quiet) {
    CalibrationProgress progress(quiet);
    progress.update(1, 3.25);
    progress.update(2, 4e-7);
  };
  EXPECT_EQ(on_terminal([&] { calibrate(false); }),
            "\rcalibrating bonds: solve 1 started after 0 s, forces out of balance "
            "3.2e+00\033[K\rcalibrating bonds: solve 2 started after 0 s, forces out of "
            "balance 4.0e-07\033[K\r\033[K");
  EXPECT_EQ(on_terminal([&] { calibrate(true); }), "");
  EXPECT_EQ(on_terminal([] { const CalibrationProgress nothing_to_calibrate(false); }), "");
  testing::internal::CaptureStderr();  // no terminal
  calibrate(false);
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

}  // namespace
}  // namespace perilink
