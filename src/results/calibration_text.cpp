#include "results/calibration_text.hpp"
#include "base/plain_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

namespace perilink {
namespace {

/// Residual above which the calibration warns; it exceeds the errors expected of a coarse model.
constexpr double harmful = 1e-2;

}  // namespace

std::string calibration_line(const CalibrationReport& report) {
  if (report.free_bonds == 0) return "no bond had to change";
  std::string line =
      fmt::format("{}, forces out of balance {:.2g} before, {:.1e} after, weights {:.3g} to {:.3g}",
                  counted(report.free_bonds, "bond"), report.residual_before, report.residual_after,
                  report.smallest_weight, report.largest_weight);
  if (report.at_least_weight > 0) line += fmt::format(", {} at the floor", report.at_least_weight);
  if (report.dropped > 0) line += fmt::format(", {} left out", report.dropped);
  return line;
}

std::optional<std::string> calibration_shortfall(const Network& network) {
  if (!network.report.calibration || network.report.calibration->unmet == 0) return std::nullopt;
  const CalibrationReport& report = *network.report.calibration;
  const double worst = std::max(report.residual_after, report.moment_after);
  std::string text = fmt::format(
      "uniform strains leave {} out of balance, most (by {:.1e} of the force on a face "
      "of its cell) the one at ({})",
      counted(report.unmet, "particle"), worst,
      joined(network.particles.position(report.worst_particle)));
  if (worst > harmful) {
    text +=
        "; WARNING: strains around it have about this relative error; mesh "
        "that region more evenly, choose another seed or a longer horizon";
  }
  return text;
}

nlohmann::ordered_json calibration_json(const CalibrationReport& report) {
  return {{"free_bonds", report.free_bonds},         {"residual_before", report.residual_before},
          {"residual_after", report.residual_after}, {"moment_after", report.moment_after},
          {"unmet_particles", report.unmet},         {"smallest_weight", report.smallest_weight},
          {"largest_weight", report.largest_weight}, {"bonds_at_floor", report.at_least_weight},
          {"bonds_left_out", report.dropped},        {"iterations", report.iterations}};
}

}  // namespace perilink
