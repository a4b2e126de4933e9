#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "analysis/quasistatic/damage_analysis.hpp"
#include "analysis/quasistatic/elastic_analysis.hpp"
#include "app/run/summary.hpp"
#include "model/model.hpp"

/// \file
/// Results common to damage and elastic runs, which are sequences of equilibria.

namespace perilink {

/// The elastic equilibrium of a body at load factor 1.
struct ElasticAnswer {
  Termination termination = Termination::completed;
  std::string reason;
  ElasticResult solution;
  StepRecord row;  ///< the only row of its history
  PeakWatch peaks;
};

/// \throws SolverError when the stiffness matrix is not positive definite
ElasticAnswer solve_elastic(const Model& model, const ElasticOptions& options);

/// Force on the body at a load region or boundary region.
struct RegionForce {
  std::string name;
  std::vector<double> force;  ///< size dim [force]

  template <class Archive>
  void serialize(Archive& archive) {
    archive(name, force);
  }
};

/// Whether there are several load or boundary regions; a single one carries the whole load.
inline bool has_several_places(const Model& model) {
  return model.load_regions.size() + model.prescribed_regions.size() > 1;
}

/// Returns the forces of all load and boundary regions at a load factor.
/// \param secants  one per element; used with `motion` for boundary regions only
/// \param motion   at load factor 1, shape (particles, width) [length]
/// \param forces   internal forces, where they are known (InternalForce::forces)
/// \param whole    see ModelState::whole
std::vector<RegionForce> region_forces(const Model& model, double load_factor, Secants secants,
                                       std::span<const double> motion,
                                       std::vector<double> forces = {},
                                       std::span<const std::uint8_t> whole = {});

/// Results of a sequence of equilibria for the summary.
struct Equilibria {
  explicit Equilibria(const DamageResult& result);
  explicit Equilibria(const ElasticAnswer& answer);

  const StepRecord& last;  ///< row of the history
  const PeakWatch& peaks;
  std::optional<CurvePoint> other_peak = {};  ///< see DamageResult
  bool has_events = false;                    ///< bonds break or yield
  const FactorStatistics& factor;
  std::string solver;              ///< description of the solver and its work
  double unsolved = 0.0;           ///< error of the iterations in the energy norm [-]
  double initial_stiffness = 0.0;  ///< [force / length]
  double largest_residual = 0.0;   ///< over the loads [-]
  Index broken_bonds = 0;          ///< includes the bond that separated the body
  double energy_error = 0.0;       ///< over the work [-]
  std::optional<double> smoothed_peak_load = {};  ///< empty for short paths of events
  std::vector<RegionForce> places =
      {};  ///< region forces at the peak, if there are several regions
  std::vector<std::string> warnings = {};  ///< without those on the balance
};

/// Reports the curve, energies and errors.
void tell_equilibria(Summary& summary, const CaseFile& input, const Equilibria& found);

/// Reports how each stage ended; does nothing without stages.
void tell_stages(Summary& summary, const CaseFile& input, const std::vector<StageResult>& stages);

/// Reports curve, energies and errors with the size of the model and the cost of its solution.
/// \param seconds  wall time of the analysis
void tell_quasistatic(Summary& summary, const CaseFile& input, const Model& model,
                      const Equilibria& found, double seconds);

}  // namespace perilink
