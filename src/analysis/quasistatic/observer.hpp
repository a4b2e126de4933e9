#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "base/types.hpp"
#include "network/network.hpp"

namespace perilink {

/// One row of the history: equilibrium of the network as it stands, at the load factor at which its
/// next element fails (or at the end of a load step). The last row of a driven body that came apart
/// shows it without resistance, `element` = no_index. Energies follow the path drawn through the
/// rows.
struct StepRecord {
  Index step = 0;
  Index broken_bonds = 0;  ///< in this equilibrium
  Index yield_events = 0;  ///< after which elements went on: bars that yield, so far
  double load_factor = 0.0;
  double load = 0.0;               ///< load factor times the reference load [force]
  double displacement = 0.0;       ///< work-conjugate to `load`: twice the energy over it [length]
  double strain_energy = 0.0;      ///< [force length]
  double dissipated_energy = 0.0;  ///< sum of lambda_k lambda_(k+1) (C_(k+1) - C_k) / 2
  double external_work = 0.0;      ///< trapezoids under the path of loads and displacements
  double released_energy = 0.0;    ///< sum of the elements' energies at the moment they failed
  double residual = 0.0;           ///< |f - K u| / |f| when last measured
  int factorizations = 0;
  Index element = no_index;        ///< fails at this load
  Index events = 1;                ///< elements that fail at this load
  std::vector<Index> others = {};  ///< those but `element`; not in history.csv
  Index stage = 0;                 ///< number of the stage, from one; 0: the run has none
  Index at_constant_load =
      0;                  ///< 1: the element was beyond its limit, at a load that does not move
  Index side_change = 0;  ///< 1: the element and others close or open, and nothing fails
  Index elements = 0;     ///< that carry particles in this equilibrium
  double constraint_energy = 0.0;  ///< PathEnergy::freed() so far [force length]
  double seconds = 0.0;            ///< wall time of this step; goes to timing.csv only
};

/// State that observers may look at, valid during the call only.
struct StepState {
  const Network& network;
  Secants secants;
  /// Shape (particles, width); at load factor 1, of runs by stages under all loads as they are.
  std::span<const double> displacement;
  /// Per finite element, whether it carries its particles; empty where the body has none.
  std::span<const std::uint8_t> whole = {};
};

/// How a run ended.
enum class Termination {
  completed,       ///< all steps done, or a stop rule met
  collapsed,       ///< the specimen separated
  nothing_breaks,  ///< no bond can break under this load
  interrupted,     ///< by a signal
  failed,          ///< the solver could not continue
};
std::string to_string(Termination termination);

/// Makes the state when an observer asks for it.
class StateSource {
 public:
  virtual ~StateSource() = default;
  virtual StepState state() = 0;
  /// The secants alone, which cost nothing.
  virtual Secants secants() { return state().secants; }
};

/// Watches an analysis. The analysis knows nothing of files.
class StepObserver {
 public:
  virtual ~StepObserver() = default;
  /// After every row. `source` gives the network in that equilibrium when asked, since
  /// displacements of the whole body may cost a solve.
  virtual void on_step(const StepRecord& record, StateSource& source) = 0;
  /// Once, at the end: the last equilibrium (before the body separated, if it did).
  virtual void on_end(const StepRecord& /*last*/, StateSource& /*source*/) {}
  /// Whether to stop now (a signal came).
  virtual bool stop_requested() { return false; }
};

}  // namespace perilink
