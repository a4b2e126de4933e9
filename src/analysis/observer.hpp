#pragma once

#include <span>
#include <string>

#include "assembly/network.hpp"
#include "base/types.hpp"

namespace perilink {

/// One row of the history: the state at the moment of an event (or at the end of a load step). All
/// energies follow the path drawn through the rows.
struct StepRecord {
  Index step = 0;
  Index broken_bonds = 0;         ///< after this step
  Index yield_events = 0;         ///< of bars, after this step
  double load_factor = 0.0;
  double load = 0.0;              ///< load factor times the reference load [force]
  double displacement = 0.0;      ///< work-conjugate to `load` [length]
  double strain_energy = 0.0;     ///< [force length]
  double dissipated_energy = 0.0; ///< sum of lambda_k lambda_(k+1) (C_(k+1) - C_k) / 2
  double external_work = 0.0;     ///< trapezoids under the path of load and displacement
  double released_energy = 0.0;   ///< energy of the elements at the moment they failed
  double residual = 0.0;          ///< |f - K u| / |f| when last looked at
  int factorizations = 0;
  Index element = no_index;       ///< that fails at the end of this step
  double seconds = 0.0;           ///< wall time of this step; goes to timing.csv only
};

/// State that observers may look at, valid during the call only.
struct StepState {
  const Network& network;
  std::span<const double> secants;
  std::span<const double> displacement;  ///< at load factor 1, shape (particles, dim)
};

/// How a run ended.
enum class Ending {
  completed,     ///< all steps done, or a stop rule met
  collapsed,     ///< the specimen separated
  nothing_breaks,///< no bond can break under this load
  interrupted,   ///< by a signal
  failed,        ///< the solver could not continue
};
std::string to_string(Ending ending);

/// Watches an analysis. The analysis knows nothing of files.
class StepObserver {
 public:
  virtual ~StepObserver() = default;
  /// After every row. `state` gives the network at the moment of the event, before the element
  /// fails; it is made only when asked for, since displacements of the whole body may cost a solve.
  virtual void on_step(const StepRecord& record, class StateSource& source) = 0;
  /// Whether to stop now (a signal came).
  virtual bool stop_requested() { return false; }
};

/// Makes the state when an observer asks for it.
class StateSource {
 public:
  virtual ~StateSource() = default;
  virtual StepState state() = 0;
};

}  // namespace perilink
