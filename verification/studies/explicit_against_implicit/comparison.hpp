#pragma once

#include <string>
#include <vector>

#include "analysis/dynamics/bonds/runs/bond_analysis.hpp"
#include "analysis/quasistatic/damage_analysis.hpp"

namespace perilink::verification {

/// A body that both modes load by the same motion of its boundary.
struct Specimen {
  std::string name;
  Network network;
  Unknowns unknowns;
  Loads loads;
  ReferenceLoad reference;
  DamageOptions options;
};

/// From a case file whose body is driven by displacements; the density is one.
Specimen read_specimen(const std::string& name, const std::string& path);

/// What one mode found.
struct Outcome {
  double peak_load = 0.0;            ///< [force]
  double peak_displacement = 0.0;    ///< [length]
  std::vector<std::uint8_t> broken;  ///< bonds, when the load has fallen or at the end
  double dissipated = 0.0;           ///< [force length]
  double seconds = 0.0;
  Index steps = 0;
  double surplus = 0.0;  ///< energy that appeared, over the work
};

Outcome run_implicit(const Specimen& specimen);

/// Moved to `stretch` times the displacement at which the implicit run has its peak, in `periods`
/// fundamental periods, then held for a quarter of that time. Damping: rate 2 omega_1.
Outcome run_explicit(const Specimen& specimen, const Outcome& implicit, double stretch,
                     double periods, int threads);

/// Particles with a broken bond in both outcomes over those with one in either.
double crack_overlap(const Network& network, const Outcome& a, const Outcome& b);

}  // namespace perilink::verification
