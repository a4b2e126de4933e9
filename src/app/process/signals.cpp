#include "app/process/signals.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <initializer_list>

namespace perilink {
namespace {

volatile std::sig_atomic_t stop_requested = 0;
volatile std::sig_atomic_t is_terminal[] = {0, 0, 0};  ///< initial state of the file descriptors
volatile std::sig_atomic_t nowhere = -1;

/// Redirects output to a closed terminal to /dev/null, because every write to it fails. System and
/// shell may both signal the closure, so a second call does nothing.
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
    // Signals ignored by nohup or by the shell for background jobs stay ignored.
    if (std::signal(signal, on_stop_signal) == SIG_IGN) std::signal(signal, SIG_IGN);
  }
  std::signal(SIGPIPE, SIG_IGN);
  // Buffers standard output until the program ends, when a failed write does no harm.
  constexpr std::size_t longest_summary = 1 << 16;
  std::setvbuf(stdout, nullptr, _IOFBF, longest_summary);
}

bool stop_signal_received() { return stop_requested != 0; }

}  // namespace perilink
