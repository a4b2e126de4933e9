#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "analysis/quasistatic/damage_analysis.hpp"
#include "analysis/quasistatic/elastic_analysis.hpp"
#include "app/model/model.hpp"
#include "app/run/summary.hpp"

/// \file
/// What damage and elastic runs find and tell alike: both go from equilibrium to equilibrium.

namespace perilink {

/// The elastic equilibrium of a body at load factor 1.
struct ElasticAnswer {
  Termination termination = Termination::completed;
  std::string reason;
  ElasticResult solution;
  StepRecord row;  ///< all its history
  PeakWatch peaks;
};

/// \throws SolverError when the stiffness matrix is not positive definite
ElasticAnswer solve_elastic(const Model& model, const ElasticOptions& options);

/// Force on the body at a loaded or driven place.
struct RegionForce {
  std::string name;
  std::vector<double> force;  ///< size dim [force]
};

/// Whether there are several; one bears the whole load.
inline bool has_several_places(const Model& model) {
  return model.load_regions.size() + model.prescribed_regions.size() > 1;
}

/// Forces of all places at a load factor.
/// \param secants  one per element; this and the next only looked at where places are driven
/// \param motion   at load factor 1, shape (particles, width) [length]
/// \param forces   that hold the particles so, where they are known (InternalForce::forces)
/// \param whole    see ModelState::whole
std::vector<RegionForce> region_forces(const Model& model, double load_factor, Secants secants,
                                       std::span<const double> motion,
                                       std::vector<double> forces = {},
                                       std::span<const std::uint8_t> whole = {});

/// What equilibria tell.
struct Equilibria {
  explicit Equilibria(const DamageResult& result);
  explicit Equilibria(const ElasticAnswer& answer);

  const StepRecord& last;  ///< row of the history
  const PeakWatch& peaks;
  bool has_events = false;  ///< bonds break or yield
  const FactorStatistics& factor;
  std::string solver;                             ///< what it took
  double unsolved = 0.0;                          ///< left by iterations, norm of energy [-]
  double initial_stiffness = 0.0;                 ///< [force / length]
  double largest_residual = 0.0;                  ///< over the loads [-]
  Index broken_bonds = 0;                         ///< with the one that separated the body
  double energy_error = 0.0;                      ///< over the work [-]
  std::optional<double> smoothed_peak_load = {};  ///< where the path of events is long enough
  std::vector<RegionForce> places = {};           ///< at the peak, where there are several
  std::vector<std::string> warnings = {};         ///< beside those about the balance
};

/// Curve, energies and errors.
void tell_equilibria(Summary& summary, const CaseFile& input, const Equilibria& found);

/// How each stage ended; nothing where there are none.
void tell_stages(Summary& summary, const CaseFile& input, const std::vector<StageResult>& stages);

/// The same with the model and what its solution took.
/// \param seconds  that the analysis took
void tell_quasistatic(Summary& summary, const CaseFile& input, const Model& model,
                      const Equilibria& found, double seconds);

}  // namespace perilink
