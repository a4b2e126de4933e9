#pragma once

#include <string>

#include "released.hpp"

namespace perilink::verification {

/// Concrete of the study: E = 30 000, f_t = 3, G_F = 0.1 in N and mm; E G_F / f_t^2 is 333 mm.
inline constexpr double tensile_strength = 3.0, fracture_energy = 0.1;

/// How the specimens are made up.
struct Make {
  std::string model = "bond_based";
  std::string pattern = "rectangular";  ///< a cubic one makes the specimen three-dimensional,
                                        ///< "mesh" has the triangles of strip.geo, beam.geo
  std::string softening = "bilinear";
  double spacing = 5.0;        ///< [mm]
  double horizon_ratio = 3.0;  ///< horizon over spacing
  /// Bilinear curves have a knee; the default is that of Petersson.
  double knee_stress_ratio = 1.0 / 3.0, knee_opening_ratio = 2.0 / 9.0;
  double longer = 0.0;  ///< by which strip() and its part that may soften are longer [mm]
};

/// A strip 100 mm long and 50 mm wide (in space a bar 60 mm long and 40 mm square), driven apart
/// along x until nothing resists, whose middle of two horizons and two spacings may soften, as the
/// text of a case.
std::string strip(const Make& make);

/// Length of the part of strip() that may soften [mm].
double soft_length_of(const Make& make);

/// Area that a crack across strip() has [mm^2].
double section_of(const Make& make);

/// A beam of the depth D, 1 mm thick, on a span of 4 D with a load at mid-span.
struct Beam {
  double depth = 100.0;         ///< [mm]
  double notch = 0.0;           ///< depth of the pre-crack below the load over D
  double patch = 0.05;          ///< width of the load over D, at least two spacings
  bool point_supports = false;  ///< or patches as wide as the load, which hold a little moment
  double load_fraction = 0.5;   ///< the run ends at this part of the peak
};
std::string beam(const Make& make, const Beam& size);

/// What a run of a case tells.
struct Outcome {
  double peak = 0.0;        ///< load, of the envelope of equal energy where there is one [N]
  double dissipated = 0.0;  ///< [N mm]
  double energy_error = 0.0;
  int events = 0;
  std::string termination;
  Released released;  ///< strips whose run did not fail; else not a number
};
/// \param make  a strip whose bonds tell where they took the energy; null: another body
Outcome run_text(const std::string& text, const Make* make = nullptr);

}  // namespace perilink::verification
