#pragma once

#include <optional>
#include <vector>

#include "analysis/quasistatic/damage_analysis.hpp"
#include "app/plot/plot_body.hpp"
#include "crack_path.hpp"
#include "specimens.hpp"

namespace perilink::verification {

/// Energy dissipated and what the crack of that moment accounts for.
struct GrowthPoint {
  double crack_energy = 0.0;  ///< sum of G_F over the crack's area [force length]
  double dissipated = 0.0;    ///< [force length]
};

/// What one run shows.
struct CrackRun {
  Specimen specimen;
  DamageResult result;
  CrackPath path;
  StrayBreaks stray;
  double first_load = 0.0;   ///< the first bond breaks at it [force]
  double smooth_peak = 0.0;  ///< largest load, smoothed over one horizon of growth [force]
  /// Block: E s_c A, at which uniform stress breaks the first bond; cracked beam: Griffith's
  /// [force].
  std::optional<double> reference_load;
  double plane_ratio = 0.0;         ///< plane_crack_energy_ratio()
  double growth_ratio = 0.0;        ///< slope of dissipated over crack energy, least squares
  std::vector<GrowthPoint> growth;  ///< at equal numbers of broken bonds
  PlotBody body;                    ///< at the end
  double seconds = 0.0;
};

/// Grows the crack of a specimen until the load is gone.
CrackRun run_specimen(const Specimen& specimen, int threads);

}  // namespace perilink::verification
