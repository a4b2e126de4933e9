#pragma once

#include <array>
#include <vector>

#include "specimens.hpp"

namespace perilink::verification {

using Place = std::array<double, 2>;

/// What a run tells.
struct Crack {
  double peak = 0.0;           ///< largest load [force]
  double smoothed_peak = 0.0;  ///< the same by the envelope of equal energy; zero: none
  double energy_error = 0.0;
  int unknowns = 0;
  int events = 0;
  double horizon = 0.0;       ///< [length]
  std::vector<Place> broken;  ///< middles of the bonds that broke [length]
  double set_up = 0.0;        ///< time of the particles and bonds [s]
  double breaking = 0.0;      ///< time of the analysis [s]
};

/// \throws Error where the run fails
Crack run_specimen(const Specimen& specimen);

/// A straight line from the tip through the bonds that broke.
struct Direction {
  double angle = 0.0;   ///< against x, in the sense of growth [degrees]
  double spread = 0.0;  ///< root mean square distance from the line over the horizon
};

/// Line of least squares from the tip through the middles of those that broke farther than one
/// horizon and nearer than so many from it.
Direction direction_of(const Crack& crack, const Place& tip, double horizons = 4.5);

/// Energy that a long crack dissipates per area, over the fracture energy, in clamped_strip().
struct StripEnergy {
  double dissipated = 0.0;
  int events = 0;
};
StripEnergy energy_of_strip(const Make& make);

}  // namespace perilink::verification
