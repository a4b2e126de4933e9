#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "base/types.hpp"
#include "network/network.hpp"

namespace perilink {

/// One row of the history: equilibrium at the load factor of the next event, or at the end of a
/// load step. If a body under prescribed displacements separates, its last row shows no resistance
/// and has `element` = no_index. Energies follow the path through the rows.
struct StepRecord {
  Index step = 0;
  Index broken_bonds = 0;  ///< in this equilibrium
  Index yield_events = 0;  ///< events so far after which the element went on, as bars that yield
  double load_factor = 0.0;
  double load = 0.0;               ///< load factor times the reference load [force]
  double displacement = 0.0;       ///< work-conjugate to `load`: twice the energy over it [length]
  double strain_energy = 0.0;      ///< [force length]
  double dissipated_energy = 0.0;  ///< along the path, see PathEnergy
  double external_work = 0.0;      ///< trapezoids under the path of loads and displacements
  double released_energy = 0.0;    ///< sum of the energies of elements when they failed
  double residual = 0.0;           ///< |f - K u| / |f| when last measured
  int factorizations = 0;
  Index element = no_index;        ///< element that fails at this load
  Index events = 1;                ///< number of elements that fail at this load
  std::vector<Index> others = {};  ///< elements that fail with `element`; not in history.csv
  Index stage = 0;                 ///< number of the stage, from one; 0: the run has none
  Index at_constant_load = 0;      ///< 1: the element was beyond its limit at a constant load
  Index side_change = 0;           ///< 1: bonds change their contact state and no element fails
  Index elements = 0;              ///< active hosts in this equilibrium
  double constraint_energy = 0.0;  ///< PathEnergy::freed() so far [force length]
  /// With stages: |load| of the growing load case alone that stores the strain energy [force]; not
  /// in history.csv.
  double equivalent_load = 0.0;
  double seconds = 0.0;  ///< wall time of this step; in timing.csv only

  template <class Archive>
  void serialize(Archive& archive) {
    archive(step, broken_bonds, yield_events, load_factor, load, displacement, strain_energy,
            dissipated_energy, external_work, released_energy, residual, factorizations, element,
            events, others, stage, at_constant_load, side_change, elements, constraint_energy,
            equivalent_load, seconds);
  }
};

/// Returns the part of the elements of a batch that fail at about the load of its row: all but the
/// last one, which leads to the next row as a single event does.
inline double part_at_constant_load(double events) {
  return events > 1.0 ? 1.0 - 1.0 / events : 0.0;
}

/// State for observers, valid during the call only.
struct StepState {
  const Network& network;
  Secants secants;
  /// Shape (particles, width); at load factor 1, or under all present loads in runs by stages.
  std::span<const double> displacement;
  /// Flag per finite element: it is an active host. Empty if the body has none.
  std::span<const std::uint8_t> whole = {};
};

/// Termination status of a run.
enum class Termination {
  completed,       ///< all steps done, or a stop rule met
  collapsed,       ///< the specimen separated
  nothing_breaks,  ///< no bond can break under this load
  interrupted,     ///< a signal stopped the run
  failed,          ///< the solver could not continue
};
std::string to_string(Termination termination);

/// Computes the state on request.
class StateSource {
 public:
  virtual ~StateSource() = default;
  virtual StepState state() = 0;
  /// Returns the state without a solve. Displacements may belong to an earlier row where no element
  /// can fail.
  virtual StepState unsolved_state() { return state(); }
  /// Returns the displacements of an earlier unsolved_state(), made current everywhere. Costs a
  /// solve at most.
  virtual std::vector<double> completed(const StepState& earlier) {
    return {earlier.displacement.begin(), earlier.displacement.end()};
  }
  /// Returns the secant stiffness ratios, which need no solve.
  virtual Secants secants() { return state().secants; }
};

/// Receives the rows of an analysis, which does not depend on files.
class StepObserver {
 public:
  virtual ~StepObserver() = default;
  /// Called after every row. `source` computes the state in that equilibrium on request, since
  /// displacements of the whole body may cost a solve.
  virtual void on_step(const StepRecord& record, StateSource& source) = 0;
  /// Called once at the end with the last equilibrium, before any separation.
  virtual void on_end(const StepRecord& /*last*/, StateSource& /*source*/) {}
  /// Returns whether to stop now, for example after a signal.
  virtual bool stop_requested() { return false; }
};

}  // namespace perilink
