#include "app/process/signals.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <initializer_list>

namespace perilink {
namespace {

volatile std::sig_atomic_t stop_requested = 0;
volatile std::sig_atomic_t is_terminal[] = {0, 0, 0};  ///< what the file descriptors were at first
volatile std::sig_atomic_t nowhere = -1;

/// A terminal that is gone fails every write: what was meant for it goes nowhere instead. Both the
/// system and the shell may tell of it, so that a second time means nothing.
void leave_terminal() {
  for (const int file : {STDOUT_FILENO, STDERR_FILENO}) {
    if (is_terminal[file] != 0 && nowhere >= 0) dup2(nowhere, file);
  }
}

extern "C" void on_stop_signal(int signal) {
  stop_requested = 1;
  if (signal == SIGHUP) {
    leave_terminal();
  } else {
    std::signal(signal, SIG_DFL);
  }
}

}  // namespace

void catch_stop_signals() {
  for (const int file : {STDOUT_FILENO, STDERR_FILENO}) is_terminal[file] = isatty(file);
  if (nowhere < 0) nowhere = open("/dev/null", O_WRONLY | O_CLOEXEC);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    // What nohup, or a shell for its background, has switched off stays off.
    if (std::signal(signal, on_stop_signal) == SIG_IGN) std::signal(signal, SIG_IGN);
  }
  std::signal(SIGPIPE, SIG_IGN);
  // Written when the program ends and nothing depends on it any more.
  constexpr std::size_t longest_summary = 1 << 16;
  std::setvbuf(stdout, nullptr, _IOFBF, longest_summary);
}

bool stop_signal_received() { return stop_requested != 0; }

}  // namespace perilink
