#include "calibration/expected_calibration.hpp"

#include <algorithm>

namespace perilink {
namespace {

/// Rates for each free bond (10 000 to 1 000 000 of them, one core). Lattices and unstructured
/// particle sets scatter around them by a factor of three.
constexpr double seconds_in_plane = 10e-6, seconds_in_space = 35e-6, times_with_moments = 3.0;
/// Memory of every bond, and of the equations of each free bond in space. In the plane the run
/// itself takes more than the equations.
constexpr double bytes_of_bond = 100.0, bytes_of_free_bond = 1000.0;

}  // namespace

CalibrationReport expected_calibration(const CalibrationInput& input, bool moments) {
  const bool in_plane = input.particles.dim == 2;
  CalibrationReport report;
  report.free_bonds = input.all_free()
                          ? input.bonds.size()
                          : static_cast<Index>(std::count(input.free.begin(), input.free.end(), 1));
  report.seconds = report.free_bonds * (in_plane ? seconds_in_plane : seconds_in_space) *
                   (moments ? times_with_moments : 1.0);
  report.bytes = bytes_of_bond * input.bonds.size() +
                 (in_plane ? 0.0 : bytes_of_free_bond * report.free_bonds);
  return report;
}

}  // namespace perilink
