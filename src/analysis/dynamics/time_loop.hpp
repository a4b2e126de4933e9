#pragma once

#include <algorithm>
#include <cmath>
#include <exception>
#include <string>

#include "analysis/dynamics/explicit_run.hpp"
#include "base/memory.hpp"
#include "base/thread_choice.hpp"

namespace perilink {

/// The frame of every explicit run: how long its steps are, when rows come and how it ends. What a
/// step does is the caller's.
class ExplicitLoop {
 public:
  /// \throws std::invalid_argument where the time step exceeds the critical one (unless
  /// refuse_unstable is off) or the duration is not positive
  ExplicitLoop(const ExplicitOptions& options, double critical_time_step);

  double time_step() const { return result_.time_step; }
  double load_factor(Index step) const;
  bool is_done() const { return done_; }
  /// Ends the run where another process has looked at it.
  void leave() { done_ = true; }
  /// So far; what run() returns has that of the steps it knew of.
  const ExplicitResult& result() const { return result_; }
  /// Whether look() has to be called at a step.
  bool is_looked_at(Index step) const { return is_row(step) || step % steps_between_checks == 0; }

  /// Calls one_step(step) for every step, each by all threads of the round.
  /// What an observer throws ends the run as failed.
  template <class OneStep>
  ExplicitResult run(int most_threads, OneStep one_step) {
    ThreadChoice choice(most_threads);
    for (Index begin = 0; begin <= steps_ && !done_; begin += steps_of_a_round) {
      const Index end = std::min(begin + steps_of_a_round, steps_ + 1);
      const Timer timer;
#pragma omp parallel num_threads(choice.threads())
      for (Index step = begin; step < end && !done_; ++step) one_step(step);
      if (tells_of_steps(begin)) choice.took(timer.seconds());
    }
    if (!failure_.empty()) end(Termination::failed, failure_);
    return result_;
  }

  /// To be called by one thread, between barriers: ends runs whose energy grows, asks the observer
  /// whether to stop, and tells it of rows. Where energies are no numbers any more there is no row.
  /// \param record    has the energies of this step, and the reactions of the last
  /// \param complete  fills in what else a row of this body has
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

  /// \param displacement  at the driven particles in this step [length]
  void note_reaction(double supports, double displacement) {
    if (!(std::abs(supports) > std::abs(result_.peak_load))) return;  // nor for what is no number
    result_.peak_load = supports;
    result_.peak_displacement = displacement;
  }

 private:
  static constexpr Index steps_between_checks = 200, steps_of_a_round = 2;

  bool is_row(Index step) const { return step % between_rows_ == 0 || step == steps_; }
  /// Whether a round has no row, whose files take longer than steps, or most rounds have one.
  bool tells_of_steps(Index begin) const {
    const Index next_row = (begin + between_rows_ - 1) / between_rows_ * between_rows_;
    return next_row >= begin + steps_of_a_round || between_rows_ < 4 * steps_of_a_round;
  }
  void end(Termination termination, const std::string& reason);
  /// Why the motion may have grown.
  std::string why() const;
  void check_growth(Index step, const EnergyBalance& energy);
  void note_row(const ExplicitRecord& record);

  /// Exceptions must not leave a parallel region.
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
  double initial_ = 0.0, supplied_ = 0.0, largest_surplus_ = 0.0;  ///< energies
  bool done_ = false, overflowed_ = false;
  std::string failure_;  ///< what an observer failed with
  ExplicitResult result_;
};

}  // namespace perilink
