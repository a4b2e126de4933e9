#pragma once

#include <string>

namespace perilink::verification {

/// Bodies of brittle bonds, E = 30 000 MPa, G_F = 0.1 N/mm, that forces break until the load has
/// fallen to 0.3 of its peak.
enum class Scene {
  beam,   ///< on three points, pre-crack of 0.3 of its height, 400 by 100 mm; its middle can break
  prism,  ///< the beam, 50 mm wide in space, horizon of two spacings, until 600 bonds are broken
  panel,  ///< L-shaped, 500 by 500 mm, clamped below, pushed up at its arm; crack from the corner
  block,  ///< in tension between caps, 100 by 200 mm, with a weak place on its left side
};

/// \param elements  the table [elements]; empty: all particles are free
std::string case_of(Scene scene, double spacing, const std::string& elements);

/// A run of its own process, so that time and memory are its own.
struct Run {
  int unknowns = 0, unknowns_at_end = 0;
  int events = 0, conversions = 0;
  double peak = 0.0, smoothed_peak = 0.0, dissipated = 0.0, freed = 0.0;
  double crack = 0.0;      ///< mean x of the broken bonds' middles [mm]
  double height = 0.0;     ///< largest y of them [mm]
  double seconds = 0.0;    ///< processor time, set-up and all
  double set_up = 0.0;     ///< part of it before the first event
  double gigabytes = 0.0;  ///< peak memory
};

/// Runs the case on one thread in a child.
/// \throws std::runtime_error where the child fails
Run measure(const std::string& text);

}  // namespace perilink::verification
