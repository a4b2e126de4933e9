#pragma once

#include <memory>
#include <span>

#include "analysis/quasistatic/ranks/part_solver.hpp"

namespace perilink {

/// Whether ranks can share the work on a network: their parts have bonds and springs, no more.
inline bool can_be_shared(const Network& network, const Unknowns& unknowns) {
  return !network.has_states() && !network.cells && !network.shell && !unknowns.carries();
}

/// All ranks at work on one body, seen from the one that leads. The others are in serve().
class Team {
 public:
  /// Cuts the body into parts and sends them.
  /// \param stiffness  its blocks inverted
  Team(Ranks& ranks, const Network& network, const Unknowns& unknowns, Secants secants,
       const BoxMotions& motions, const BoxStiffness& stiffness);

  /// conjugate_gradients() of the whole body; vectors have all its unknowns.
  GradientsReport search(std::span<const double> right, std::span<double> solution, double enough,
                         double scale, int most_iterations);

  FactorStatistics coarse() const { return own_->coarse(); }

 private:
  Ranks& ranks_;
  Partition partition_;
  std::unique_ptr<PartSolver> own_;
};

/// What the other ranks do until the first dismisses them. What goes wrong here ends all ranks with
/// a message: the others would wait for ever.
void serve(Ranks& ranks);

/// Lets the other ranks come back from serve().
void dismiss(Ranks& ranks);

}  // namespace perilink
