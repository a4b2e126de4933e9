#pragma once

#include <optional>
#include <vector>

#include "analysis/quasistatic/equilibrium/body/event_outcome.hpp"
#include "analysis/quasistatic/equilibrium/displacement/solution.hpp"

namespace perilink {

/// Work of the reactions at prescribed displacements. It is summed over the elements there from
/// time to time; between, it follows from the growth of the compliance f'u - R'd.
class ReactionWork {
 public:
  explicit ReactionWork(const Solution& solution) : solution_(solution) { find_elements(); }

  /// Returns whether elements have an end at a prescribed displacement.
  bool is_driven() const { return !driven_elements_.empty(); }
  /// Returns the last f'u + R'd of a body that resisted.
  double last() const { return last_; }

  /// Finds the elements at prescribed displacements of a new stage.
  void begin_stage();
  /// Sums the work anew when it is needed next.
  void sum_anew() { followed_.reset(); }
  /// Adds the growth of the compliance by an event.
  /// \param is_sure  the growth has no larger error than displacements have
  void grow(double growth, bool is_sure);

  /// Returns the work if it follows from the last sum.
  /// \param forces  f'u
  std::optional<LoadWork> followed(double forces);
  /// Returns the work summed over the elements; nothing if the terms cancel.
  std::optional<LoadWork> sum() const;
  /// Sets a sum, from which the work then follows.
  /// \return the sum, with whether the body has separated
  LoadWork follow(LoadWork work);

 private:
  void find_elements();
  std::pair<double, double> work_of(Index element) const;

  const Solution& solution_;
  std::vector<Index> driven_elements_;
  double spring_work_ = 0.0;  ///< work of elastic supports at prescribed displacements
  double last_ = 0.0;
  /// The last sum.
  struct Followed {
    double compliance;  ///< updated by its growth
    double from;        ///< f'u + R'd when it was summed
    int events_left;    ///< events before the next sum
  };
  std::optional<Followed> followed_;  ///< empty: the work must be summed
};

}  // namespace perilink
