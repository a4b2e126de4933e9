#include "app/process/process_pool.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <utility>

#include "base/error.hpp"

namespace perilink {
namespace {

/// Most text kept of a process's standard error [bytes].
constexpr std::size_t longest_errors = 1 << 16;

/// The child's part of start(); only calls that are safe between fork and exec.
[[noreturn]] void become(const char* program, char* const* words, int errors, pid_t parent) {
  // Files stay whole when runs are killed. Without this they would go on without the parent.
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != parent) _exit(127);
  setpgid(0, 0);
  const int nowhere = open("/dev/null", O_RDWR | O_CLOEXEC);
  if (nowhere < 0 || dup2(nowhere, STDIN_FILENO) < 0 || dup2(nowhere, STDOUT_FILENO) < 0 ||
      dup2(errors, STDERR_FILENO) < 0) {
    _exit(127);
  }
  execv(program, words);
  _exit(127);
}

/// Reads what a pipe holds. \return whether its other end is closed
bool drain(int pipe, std::string& text) {
  std::array<char, 4096> buffer;
  const ssize_t got = read(pipe, buffer.data(), buffer.size());
  if (got < 0) return errno != EINTR;
  const std::size_t kept = std::min(static_cast<std::size_t>(got), longest_errors - text.size());
  text.append(buffer.data(), kept);
  return got == 0;
}

}  // namespace

ProcessPool::~ProcessPool() {
  for (const Child& child : children_) {
    kill(child.id, SIGKILL);
    waitpid(child.id, nullptr, 0);
    close(child.errors);
  }
}

void ProcessPool::start(std::size_t number, const std::vector<std::string>& arguments) {
  std::vector<std::string> copies = words_;
  copies.insert(copies.end(), arguments.begin(), arguments.end());
  std::vector<char*> words;
  for (std::string& copy : copies) words.push_back(copy.data());
  words.push_back(nullptr);
  std::array<int, 2> ends{};
  const bool piped = pipe2(ends.data(), O_CLOEXEC) == 0;
  const pid_t parent = getpid();
  const pid_t id = piped ? fork() : -1;
  if (id == 0) become(program_.c_str(), words.data(), ends[1], parent);
  const int fault = errno;
  if (piped) close(ends[1]);
  if (id < 0) {
    if (piped) close(ends[0]);
    throw SolverError(fmt::format("no more processes can be started: {}", std::strerror(fault)));
  }
  children_.push_back({id, ends[0], {number, -1, 0, ""}});
}

std::vector<FinishedProcess> ProcessPool::wait(int milliseconds) {
  std::vector<pollfd> pipes;
  for (const Child& child : children_) pipes.push_back({child.errors, POLLIN, 0});
  std::vector<FinishedProcess> ended;
  if (poll(pipes.data(), pipes.size(), milliseconds) <= 0) return ended;
  for (std::size_t k = pipes.size(); k-- > 0;) {
    Child& child = children_[k];
    if (pipes[k].revents == 0 || !drain(child.errors, child.end.errors)) continue;
    int status = 0;
    while (waitpid(child.id, &status, 0) < 0 && errno == EINTR) {
    }
    if (WIFEXITED(status)) child.end.exit_status = WEXITSTATUS(status);
    if (WIFSIGNALED(status)) child.end.signal = WTERMSIG(status);
    close(child.errors);
    ended.push_back(std::move(child.end));
    children_.erase(children_.begin() + static_cast<std::ptrdiff_t>(k));
  }
  return ended;
}

void ProcessPool::stop() {
  for (const Child& child : children_) kill(child.id, SIGTERM);
}

}  // namespace perilink
