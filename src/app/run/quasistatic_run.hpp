#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "app/run/run_kind.hpp"
#include "solver/factor.hpp"

/// \file
/// What runs from equilibrium to equilibrium, of damage and elastic ones, have in common.

namespace perilink {

/// What they find.
struct Equilibria {
  const StepRecord& last;  ///< row of the history
  const PeakWatch& peaks;
  const FactorStatistics& factor;
  Index broken_bonds = 0;          ///< with the one that separated the body, if it did
  double initial_stiffness = 0.0;  ///< [force / length]
  double largest_residual = 0.0;   ///< over the loads [-]
  double energy_error = 0.0;       ///< over the work [-]
  std::optional<double> smoothed_peak_load = {};  ///< where the path of events is long enough
};

/// Force on the body at a loaded or driven place.
struct PlaceForce {
  std::string name;
  std::vector<double> force;  ///< size dim [force]
};

/// Forces of all places at a load factor.
/// \param secants  of the elements; this and the next only looked at where places are driven
/// \param motion   at load factor 1, shape (particles, width) [length]
std::vector<PlaceForce> place_forces(const Model& model, double load_factor,
                                     std::span<const double> secants,
                                     std::span<const double> motion);

/// One place bears the whole load.
inline bool has_several_places(const Model& model) {
  return model.loaded_places.size() + model.driven_places.size() > 1;
}

/// Curve, energies and errors.
/// \param places  their forces at the peak, where there are several
void tell_equilibria(Summary& summary, const CaseFile& input, const Equilibria& found,
                     const std::vector<PlaceForce>& places = {});

/// A damage or elastic run.
class QuasistaticRun : public RunKind {
 public:
  QuasistaticRun(const CaseFile& input, int threads, bool quiet);
  std::vector<std::string> doubts() const override;
  std::string outcome() const override;
  void tell(Summary& summary) const override;
  std::string rate() const override;
  const Model& model() const { return model_; }

 protected:
  virtual Equilibria found() const = 0;
  virtual const std::vector<PlaceForce>& places() const = 0;

  Model model_;
};

}  // namespace perilink
