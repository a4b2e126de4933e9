#pragma once

#include <sys/types.h>

#include <cstddef>
#include <string>
#include <vector>

namespace perilink {

/// A process that has ended.
struct FinishedProcess {
  std::size_t number = 0;  ///< as given to start()
  int exit_status = -1;    ///< -1: a signal ended it
  int signal = 0;          ///< 0: none
  std::string errors;      ///< begin of its standard error
};

/// Several processes of one program at a time. They end with this process, also when it is killed.
/// The terminal's Ctrl-C does not reach them; stop() does.
class ProcessPool {
 public:
  /// \param program  path; "/proc/self/exe": this program
  /// \param words    begin of each command line, with the name of the program
  ProcessPool(std::string program, std::size_t most, std::vector<std::string> words = {"perilink"})
      : program_(std::move(program)), words_(std::move(words)), most_(most) {}
  /// Kills processes that still run.
  ~ProcessPool();
  ProcessPool(const ProcessPool&) = delete;
  ProcessPool& operator=(const ProcessPool&) = delete;

  bool full() const { return children_.size() >= most_; }
  bool idle() const { return children_.empty(); }

  /// Starts a process; its standard output is discarded. \throws SolverError
  void start(std::size_t number, const std::vector<std::string>& arguments);
  /// Waits until a process ends or some time has passed. \return the processes that ended
  std::vector<FinishedProcess> wait(int milliseconds);
  /// Asks all processes to stop (SIGTERM).
  void stop();

 private:
  struct Child {
    pid_t id = 0;
    int errors = -1;  ///< end of the pipe from its standard error
    FinishedProcess end;
  };

  std::string program_;
  std::vector<std::string> words_;
  std::size_t most_;
  std::vector<Child> children_;
};

}  // namespace perilink
