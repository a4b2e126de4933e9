#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "problems/block.hpp"
#include "problems/program.hpp"
#include "problems/result.hpp"
#include "problems/surface_option.hpp"

namespace {

using namespace perilink;
using namespace perilink::verification;

/// The energy error of all rows up to the one whose load first falls below a thousandth of the
/// peak: from there on the compliance grows by orders of magnitude within a few bonds.
double run_until_a_thousandth_of_peak(const Model& model, const BlockRun& whole) {
  for (const StepRecord& row : whole.rows) {
    if (row.load > 1e-3 * whole.result.peak_load) continue;
    return run_block(model, FactorRoute::in_place, row.broken_bonds, 2).result.energy_error;
  }
  return whole.result.energy_error;
}

bool run_study(const std::string& surface) {
  // 30 in of the 100 in run through the weak patch, whose G_F is 5 % lower.
  // [kip in], 1 in thick.
  const double area_energy = 70.0 * block_fracture_energy + 30.0 * block_weak_fracture_energy;
  std::string table =
      "columns,spacing,broken_bonds,ending,peak_load,dissipated_over_GF,released_over_GF,"
      "mean_height,height_deviation,energy_error,energy_error_at_the_end,largest_residual\n";
  fmt::print("{}", table);
  bool good = true;
  for (const int columns : {21, 41, 81}) {
    const Model model = make_block(columns, surface);
    const BlockRun run = run_block(model, FactorRoute::in_place, 1000000, 2);
    const double early = run_until_a_thousandth_of_peak(model, run);
    double mean = 0.0, square = 0.0;
    for (const StepRecord& row : run.rows) {
      if (row.element == no_index) continue;
      const Bonds& bonds = model.network.bonds;
      const double y = 0.5 * (model.network.particles.position(bonds.first[row.element])[1] +
                              model.network.particles.position(bonds.second[row.element])[1]);
      mean += y / static_cast<double>(run.rows.size());
      square += y * y / static_cast<double>(run.rows.size());
    }
    const std::string line = fmt::format(
        "{},{:.4g},{},{},{:.5g},{:.4f},{:.4f},{:.2f},{:.2f},{:.1e},{:.1e},{:.1e}\n", columns,
        model.lattice.spacing, run.result.broken_bonds, to_string(run.result.termination),
        run.result.peak_load, run.result.last.dissipated_energy / area_energy,
        run.result.last.released_energy / area_energy, mean,
        std::sqrt(std::max(square - mean * mean, 0.0)), early, run.result.energy_error,
        run.result.largest_residual);
    fmt::print("{}", line);
    std::fflush(stdout);
    table += line;
    good = good && early < 1e-9;
  }
  write_result(PERILINK_STUDY_DIR, table, result_file(surface));
  return good;
}

}  // namespace

/// Does the tension block dissipate G_F per area of its crack, whatever the spacing?
/// fracture_energy [--surface calibrated|none]
bool perilink::verification::run_program(const std::vector<std::string>& arguments) {
  std::vector<std::string> rest = arguments;
  return run_study(take_surface_option(rest));
}
