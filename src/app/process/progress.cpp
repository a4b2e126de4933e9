#include "app/process/progress.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace perilink {
namespace {

constexpr double terminal_interval = 0.1;  // [s]
constexpr double log_interval = 10.0;      // [s]
constexpr int bar_letters = 24;

/// Writes to standard error and ignores failures, which must not end a run.
void show(const std::string& text) {
  std::fputs(text.c_str(), stderr);
  std::fflush(stderr);
}

/// Overwrites the current line of the terminal.
void draw_line(const std::string& text) { show(fmt::format("\r{}\033[K", text)); }

void erase_line() { draw_line(""); }

}  // namespace

std::string format_duration(double seconds) {
  const long whole = std::lround(std::max(seconds, 0.0));
  if (whole < 60) return fmt::format("{} s", whole);
  if (whole < 3600) return fmt::format("{} min {:02} s", whole / 60, whole % 60);
  return fmt::format("{} h {:02} min", whole / 3600, whole % 3600 / 60);
}

ProgressBar::ProgressBar(bool quiet)
    : quiet_(quiet),
      terminal_(isatty(STDERR_FILENO) != 0),
      next_update_(terminal_ ? terminal_interval : log_interval) {}

bool ProgressBar::is_due() {
  if (quiet_) return false;
  const double now = since_start_.seconds();
  if (now < next_update_) return false;
  next_update_ = now + (terminal_ ? terminal_interval : log_interval);
  return true;
}

void ProgressBar::draw(const std::string& state, std::optional<double> done) {
  const double now = since_start_.seconds();
  const std::string left = done && *done > 0.0
                               ? fmt::format(", {} left", format_duration(now / *done - now))
                               : fmt::format(", {} so far", format_duration(now));
  if (!terminal_) {
    show(fmt::format("{}{}\n", state, left));
    return;
  }
  std::string bar;
  if (done) {
    const int full = static_cast<int>(*done * bar_letters);
    bar = "[" + std::string(full, '#') + std::string(bar_letters - full, '.') + "] ";
  }
  draw_line(bar + state + left);
  drawn_ = true;
}

void ProgressBar::finish() {
  if (drawn_) erase_line();
  drawn_ = false;
}

CalibrationProgress::CalibrationProgress(bool quiet)
    : shown_(!quiet && isatty(STDERR_FILENO) != 0) {}

CalibrationProgress::~CalibrationProgress() {
  if (drawn_) erase_line();
}

void CalibrationProgress::update(int search, double unbalanced) {
  if (!shown_) return;
  // The line stays during a solve, so it gives the time at its start.
  draw_line(
      fmt::format("calibrating bonds: solve {} started after {}, forces out of balance "
                  "{:.1e}",
                  search, format_duration(since_start_.seconds()), unbalanced));
  drawn_ = true;
}

}  // namespace perilink
