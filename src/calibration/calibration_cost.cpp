#include "calibration/calibration_cost.hpp"

#include <algorithm>
#include <cmath>

namespace perilink {
namespace {

/// Seconds per free bond, of lattices (their free bonds lie along the surface) and of clouds.
struct Rates {
  double lattice, cloud;
};

// Measured on bodies of 16 000 to 165 000 free bonds, alone on one core; lattices in space without
// moments on bodies of 27 000 to 615 000, on two cores; clouds in space of 11 000 to 206 000 on one
// core beside other programs: 60e-6 to 80e-6 of up to 30 000 bonds, 30e-6 above.
constexpr Rates in_plane{8e-6, 10e-6}, in_plane_with_moments{12e-6, 30e-6};
/// In the plane a factor of all equations takes most of the time of clouds: the rates are those of
/// so many particles and grow with this power of the number (4 000 to 149 000 particles).
constexpr double particles_of_rates = 12000.0, growth_of_factor = 0.38;
constexpr Rates in_space{35e-6, 40e-6}, in_space_with_moments{200e-6, 250e-6};
/// Where particles have fewer bonds than this in space, all equations are factorised.
constexpr double few_bonds = 30.0, in_space_by_factor = 200e-6;
/// Boxes in space, whose bonds that lie alike are made alike.
constexpr double box = 4e-6;

}  // namespace

CalibrationReport expected_calibration(const CalibrationInput& input, bool moments) {
  CalibrationReport report;
  report.free_bonds = input.all_free()
                          ? input.bonds.size()
                          : static_cast<Index>(std::count(input.free.begin(), input.free.end(), 1));
  const Rates& rates = input.particles.dim == 2 ? moments ? in_plane_with_moments : in_plane
                       : moments                ? in_space_with_moments
                                                : in_space;
  double rate = input.all_free() ? rates.cloud : input.box ? box : rates.lattice;
  const bool few = input.bonds.size() < few_bonds * input.particles.size();
  if (input.particles.dim == 3 && few && rate == in_space.lattice) rate = in_space_by_factor;
  if (input.all_free() && input.particles.dim == 2) {
    rate *= std::pow(input.particles.size() / particles_of_rates, growth_of_factor);
  }
  report.seconds = rate * report.free_bonds;
  return report;
}

}  // namespace perilink
