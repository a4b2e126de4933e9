#pragma once

#include <pybind11/pybind11.h>

#include <chrono>
#include <exception>
#include <utility>

#include "perilink.hpp"

namespace perilink {

/// Time between two calls into Python, so that calls at every row cost nothing.
inline constexpr std::chrono::milliseconds call_interval{50};

/// True once in every interval.
class Throttle {
 public:
  bool is_due() {
    const std::chrono::steady_clock::time_point now = std::chrono::steady_clock::now();
    if (now < next_) return false;
    next_ = now + call_interval;
    return true;
  }

 private:
  std::chrono::steady_clock::time_point next_ = std::chrono::steady_clock::time_point::min();
};

/// Calls Python from a run that has released the interpreter's lock. An exception of Python
/// (KeyboardInterrupt, or one of the progress function) ends the run and is raised after it.
class PythonCaller {
 public:
  explicit PythonCaller(pybind11::object progress) : progress_(std::move(progress)) {}

  /// Whether Ctrl-C, an exception or the progress function ends the run.
  bool stop_requested() { return stop_ || (signals_.is_due() && stop_requested_now()); }
  /// Whether Ctrl-C until this moment, or another cause, ends the run. Python raises
  /// KeyboardInterrupt itself after a call that returns before, and loses what it returns.
  bool stop_requested_now() {
    if (stop_) return true;
    const pybind11::gil_scoped_acquire lock;
    if (PyErr_CheckSignals() != 0) keep_error();
    return stop_;
  }

  void on_row(const RowProgress& row) {
    if (!stop_ && rows_.is_due()) call(row);
  }
  /// Calls the progress function.
  template <class... Arguments>
  void call(const Arguments&... arguments) {
    if (stop_ || progress_.is_none()) return;
    const pybind11::gil_scoped_acquire lock;
    try {
      pybind11::detail::make_caster<bool> answer;  // of Python or numpy
      const pybind11::object returned = progress_(arguments...);
      stop_ = stop_ || (!returned.is_none() && answer.load(returned, false) && !bool(answer));
    } catch (pybind11::error_already_set& error) {
      error.restore();
      keep_error();
    }
  }

  /// Raises the exception that ended the run, if there is one, and only once. Needs the lock.
  void raise() {
    if (error_) std::rethrow_exception(std::exchange(error_, nullptr));
  }
  void raise_if_stopped() {
    if (!stop_requested()) return;
    const pybind11::gil_scoped_acquire lock;
    raise();
  }

 private:
  /// Takes the error that Python has set.
  void keep_error() {
    stop_ = true;
    error_ = std::make_exception_ptr(pybind11::error_already_set());
  }

  pybind11::object progress_;
  Throttle signals_, rows_;
  bool stop_ = false;
  std::exception_ptr error_;
};

}  // namespace perilink
