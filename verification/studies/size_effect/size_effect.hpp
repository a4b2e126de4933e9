#pragma once

#include <array>
#include <vector>

#include "families.hpp"
#include "half_space.hpp"

namespace perilink::verification {

/// Largest difference of E1/E, E2/E, nu12 and nu23 (nu21) between bonds and closed form that counts
/// as agreement.
inline constexpr double acceptance = 1e-3;

/// Moduli of one particle, from its bonds and from the closed form.
struct NeighbourhoodRow {
  double poissons_ratio = 0.0;
  double depth = 0.0;  ///< a / horizon
  LayerModuli found;
  LayerModuli exact;
};

/// E1/E, E2/E, nu12, nu2: found - exact (Young's modulus is 1).
std::array<double, 4> differences(const NeighbourhoodRow& row);

/// Largest absolute difference of each.
std::array<double, 4> largest_differences(const std::vector<NeighbourhoodRow>& rows);

/// Particles of the given rows against the closed form, with the constants of the infinite body
/// there.
std::vector<NeighbourhoodRow> compare_neighbourhoods(const NeighbourhoodInput& input);

/// Apparent Young's modulus over the material's of a bar in plane stress.
struct BarRow {
  int width = 0;  ///< [horizons]
  int horizon_ratio = 0;
  double uncorrected = 0.0;     ///< from the program, surface = "none"
  double neighbourhoods = 0.0;  ///< bound on it: the same bonds in a uniform strain
  double exact = 0.0;           ///< mean of the closed form over the width
  /// From the program, surface = "calibrated"; not a number: not asked for.
  double calibrated = 0.0;
};

/// The bar must be softer than the bound, by no more than this share: strains across it are not
/// uniform.
inline constexpr double largest_relaxation = 0.0025;
/// Largest difference of the uncorrected bar from the closed form at a horizon of 12 spacings.
inline constexpr double bar_acceptance = 0.01;
/// Calibrated bars: forces and moments are in balance to 1e-10, and errors add up along the bar.
inline constexpr double calibrated_acceptance = 1e-8;

BarRow compare_bar(int width, int horizon_ratio, double poissons_ratio, bool calibrated);

}  // namespace perilink::verification
