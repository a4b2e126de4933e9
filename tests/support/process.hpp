#pragma once

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <functional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "support/temporary_directory.hpp"

namespace perilink::test {

/// Result of a process.
struct ProcessEnd {
  int exit_status = -1;  ///< -1 if a signal ended the process
  int signal = 0;        ///< signal that ended the process; 0: none
  std::string out;
  std::string err;
};

/// Limits of a process, such as RLIMIT_AS [bytes].
using ProcessLimits = std::vector<std::pair<int, rlim_t>>;

/// The program as a separate process with a working directory. Its output goes to files beside that
/// directory.
class ProgramProcess {
 public:
  /// \param directory  working directory; output goes to DIRECTORY.out and DIRECTORY.err
  ProgramProcess(const std::filesystem::path& directory, const std::vector<std::string>& arguments,
                 const ProcessLimits& limits = {})
      : out_(directory.string() + ".out"), err_(directory.string() + ".err") {
    std::string program = PERILINK_PROGRAM;
    std::vector<std::string> words = arguments;
    std::vector<char*> argv = {program.data()};
    for (std::string& word : words) argv.push_back(word.data());
    argv.push_back(nullptr);
    child_ = fork();
    if (child_ != 0) return;
    // Only calls that are safe between fork and exec.
    const int out = open(out_.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
    const int err = open(err_.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
    if (dup2(out, STDOUT_FILENO) < 0 || dup2(err, STDERR_FILENO) < 0) _exit(126);
    if (chdir(directory.c_str()) != 0) _exit(126);
    std::signal(SIGINT, SIG_DFL);
    std::signal(SIGTERM, SIG_DFL);
    for (const auto& [resource, bytes] : limits) {
      const rlimit limit{bytes, bytes};
      if (setrlimit(static_cast<__rlimit_resource>(resource), &limit) != 0) _exit(126);
    }
    execv(argv[0], argv.data());
    _exit(127);
  }
  ~ProgramProcess() {
    if (child_ <= 0) return;
    kill(child_, SIGKILL);
    waitpid(child_, nullptr, 0);
  }
  ProgramProcess(const ProgramProcess&) = delete;
  ProgramProcess& operator=(const ProgramProcess&) = delete;

  void send(int signal) const { kill(child_, signal); }

  /// Waits for a condition. \return false if the process ended first or a minute passed
  bool wait_until(const std::function<bool()>& condition) const {
    for (int k = 0; k < 6000; ++k) {
      if (condition()) return true;
      siginfo_t info{};
      if (waitid(P_PID, static_cast<id_t>(child_), &info, WEXITED | WNOHANG | WNOWAIT) != 0 ||
          info.si_pid != 0) {
        return false;
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    return false;
  }

  ProcessEnd wait() {
    ProcessEnd end;
    int status = 0;
    waitpid(child_, &status, 0);
    child_ = 0;
    if (WIFEXITED(status)) end.exit_status = WEXITSTATUS(status);
    if (WIFSIGNALED(status)) end.signal = WTERMSIG(status);
    end.out = read_text(out_);
    end.err = read_text(err_);
    return end;
  }

 private:
  std::filesystem::path out_;
  std::filesystem::path err_;
  pid_t child_ = 0;
};

/// Runs the program until it ends.
inline ProcessEnd run_program(const std::filesystem::path& directory,
                              const std::vector<std::string>& arguments,
                              const ProcessLimits& limits = {}) {
  return ProgramProcess(directory, arguments, limits).wait();
}

}  // namespace perilink::test
