#include "calibration/expected_calibration.hpp"

#include <algorithm>

namespace perilink {
namespace {

/// Rates per free bond (10 000 to 1 000 000 bonds, one core). Lattices and unstructured particle
/// sets differ from them by up to a factor of three.
constexpr double seconds_in_plane = 10e-6, seconds_in_space = 35e-6, times_with_moments = 3.0;
/// Memory per bond, and per free bond for the equations in space. In the plane the run takes more
/// memory than the equations.
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
