#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "problems/block.hpp"

/// Does the tension block dissipate G_F per area of its crack, whatever the spacing?
int main() {
  using namespace perilink;
  using namespace perilink::verification;
  // 30 in of the 100 in run through the weak patch, whose G_F is 5 % lower.
  const double area_energy = 70.0 * 0.001 + 30.0 * 0.00095;  // [kip in], 1 in thick
  std::FILE* file = std::fopen(PERILINK_STUDY_DIR "/result.csv", "w");
  const char* header =
      "columns,spacing,broken_bonds,ending,peak_load,dissipated_over_GF,released_over_GF,"
      "mean_height,height_deviation,energy_error,largest_residual\n";
  fmt::print("{}", header);
  if (file != nullptr) fmt::print(file, "{}", header);
  bool good = true;
  for (const int columns : {21, 41, 81}) {
    const Model model = make_block(columns);
    const BlockRun run = run_block(model, FactorRoute::in_place, 1000000, 2);
    double mean = 0.0, square = 0.0;
    for (const StepRecord& row : run.rows) {
      const Bonds& bonds = model.network.bonds;
      const double y = 0.5 * (model.network.particles.position(bonds.first[row.element])[1] +
                              model.network.particles.position(bonds.second[row.element])[1]);
      mean += y / static_cast<double>(run.rows.size());
      square += y * y / static_cast<double>(run.rows.size());
    }
    const std::string line = fmt::format(
        "{},{:.4g},{},{},{:.5g},{:.4f},{:.4f},{:.2f},{:.2f},{:.1e},{:.1e}\n", columns,
        model.lattice.spacing, run.result.broken_bonds, to_string(run.result.ending),
        run.result.peak_load, run.result.last.dissipated_energy / area_energy,
        run.result.last.released_energy / area_energy, mean,
        std::sqrt(std::max(square - mean * mean, 0.0)), run.result.energy_error,
        run.result.largest_residual);
    fmt::print("{}", line);
    std::fflush(stdout);
    if (file != nullptr) fmt::print(file, "{}", line);
    good = good && run.result.energy_error < 1e-8;
  }
  if (file != nullptr) std::fclose(file);
  return good ? 0 : 1;
}
