#pragma once

#include <algorithm>
#include <cmath>
#include <exception>
#include <string>

#include "analysis/dynamics/time_state.hpp"
#include "base/memory.hpp"
#include "base/thread_choice.hpp"

namespace perilink {

/// Time loop of explicit runs: length of steps, times of rows, and termination. The caller computes
/// the steps.
class ExplicitLoop {
 public:
  /// \throws std::invalid_argument where the time step exceeds the critical one (unless
  ///     refuse_unstable is off) or the duration is not positive
  ExplicitLoop(const ExplicitOptions& options, double critical_time_step);

  double time_step() const { return state_.result.time_step; }
  double load_factor(Index step) const;
  bool is_done() const { return done_; }
  /// Ends the run on a worker when the root has ended it.
  void leave() { done_ = true; }
  /// Returns the result so far, including steps noted after run() has returned.
  const ExplicitResult& result() const { return state_.result; }
  const LoopState& state() const { return state_; }
  /// Continues after the last step of a saved state.
  /// \throws std::invalid_argument where the state has another time step or more steps
  void restore(const LoopState& saved);
  /// Returns whether look() must be called at a step.
  bool is_looked_at(Index step) const { return is_row(step) || step % steps_between_checks == 0; }

  /// Calls one_step(step) for every step by all threads of the round, and after_rows() by one
  /// thread after a round with a row, unless the run has ended. An exception of an observer ends
  /// the run as failed.
  template <class OneStep, class AfterRows>
  ExplicitResult run(int most_threads, OneStep one_step, AfterRows after_rows) {
    ThreadChoice choice(most_threads);
    while (state_.step <= steps_ && !done_) {
      const Index begin = state_.step;
      const Index end = std::min(begin + steps_of_a_round, steps_ + 1);
      const Timer timer;
#pragma omp parallel num_threads(choice.threads())
      for (Index step = begin; step < end && !done_; ++step) one_step(step);
      if (tells_of_steps(begin)) choice.took(timer.seconds());
      state_.step = end;
      if (!done_ && end <= steps_ && state_.result.last.step >= begin) guarded(after_rows);
    }
    if (!failure_.empty()) end(Termination::failed, failure_);
    return state_.result;
  }

  /// Ends runs whose energy grows, asks the observer whether to stop, and passes rows to it.
  /// Without finite energies there is no row. Called by one thread, between barriers.
  /// \param record    has the energies of this step and the reactions of the last
  /// \param complete  fills in the other values of a row
  template <class Observer, class State, class Complete>
  void look(Index step, ExplicitRecord& record, Observer& observer, const State& state,
            Complete complete) {
    check_growth(step, record.energy);
    guarded([&] {
      if (!done_ && observer.stop_requested()) end(Termination::interrupted, "interrupted");
    });
    if (!is_row(step) && !done_) return;
    if (overflowed_) return;
    record.step = step;
    record.time = step * time_step();
    record.load_factor = load_factor(step);
    complete(record);
    note_row(record);
    const bool last = done_ || step == steps_;
    guarded([&] {
      observer.on_row(record, state);
      if (last) observer.on_end(record, state);
    });
  }

  /// \param supports      reaction of supports [force]
  /// \param displacement  displacement of the controlled particles in this step [length]
  void note_reaction(double supports, double displacement) {
    ExplicitResult& result = state_.result;
    if (!(std::abs(supports) > std::abs(result.peak_load))) return;  // also false for NaN
    result.peak_load = supports;
    result.peak_displacement = displacement;
  }

 private:
  static constexpr Index steps_between_checks = 200, steps_of_a_round = 2;

  bool is_row(Index step) const { return step % between_rows_ == 0 || step == steps_; }
  /// Returns whether a round has no row, or most rounds have one: writing a row takes longer than
  /// steps.
  bool tells_of_steps(Index begin) const {
    const Index next_row = (begin + between_rows_ - 1) / between_rows_ * between_rows_;
    return next_row >= begin + steps_of_a_round || between_rows_ < 4 * steps_of_a_round;
  }
  void end(Termination termination, const std::string& reason);
  /// Returns a possible cause of the growth of energy.
  std::string why() const;
  void check_growth(Index step, const EnergyBalance& energy);
  void note_row(const ExplicitRecord& record);

  /// Calls action(). An exception must not leave a parallel region: its message is stored and the
  /// run ends.
  template <class Action>
  void guarded(const Action& action) {
    try {
      action();
    } catch (const std::exception& error) {
      failure_ = failure_text(error);
      done_ = true;
    }
  }

  double ramp_;
  Index steps_ = 0, between_rows_ = 1;
  bool done_ = false, overflowed_ = false;
  std::string failure_;  ///< message of an observer's exception
  LoopState state_;
};

}  // namespace perilink
