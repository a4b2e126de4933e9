#include "discretization/calibration_cost.hpp"

#include <algorithm>

namespace perilink {
namespace {

/// Seconds per free bond, of lattices (their free bonds lie along the surface) and of clouds.
struct Rates {
  double lattice, cloud;
};

constexpr Rates in_plane{5e-6, 30e-6}, in_plane_with_moments{15e-6, 90e-6};
constexpr Rates in_space{60e-6, 300e-6}, in_space_with_moments{200e-6, 900e-6};
/// For boxes in space, whose bonds that lie alike are made alike.
constexpr double box = 1e-6;

}  // namespace

CalibrationReport expected_calibration(const CalibrationInput& input, bool moments) {
  CalibrationReport report;
  report.free_bonds = input.all_free()
                          ? input.bonds.size()
                          : static_cast<Index>(std::count(input.free.begin(), input.free.end(), 1));
  const Rates& rates = input.particles.dim == 2 ? moments ? in_plane_with_moments : in_plane
                       : moments                ? in_space_with_moments
                                                : in_space;
  const double rate = input.all_free() ? rates.cloud : input.box ? box : rates.lattice;
  report.seconds = rate * report.free_bonds;
  return report;
}

}  // namespace perilink
