// How far answers on meshes depend on round-off.
//
//   round_off [NAME]    bodies whose name holds NAME, default: all, which writes result.csv

#include <fmt/format.h>

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <string>
#include <vector>

#include "meshes.hpp"
#include "problems/program.hpp"
#include "problems/result.hpp"

namespace perilink::verification {
namespace {

std::vector<MeshBody> bodies() {
  return {{"disc", read_body("disc", 2)},
          {"disc, softening", read_body("disc", 2), 3.0, 0.0, 1.0, 3.0},
          {"L", read_body("l_shape", 2)},
          {"L, micropolar", read_body("l_shape", 2), 3.0, 0.2},
          {"plate with a hole", read_body("plate_with_hole", 2)},
          {"plate with a hole, two materials", read_body("full_plate_with_hole", 2), 3.0, 0.0, 4.0},
          {"plate with a hole, micropolar", read_body("full_plate_with_hole", 2), 3.0, 0.2},
          {"corbel", read_body("corbel", 2)},
          {"corbel, horizon of two spacings", read_body("corbel", 2), 2.0},
          {"L in space", read_body("l_block_coarse", 3)},
          {"cylinder", read_body("cylinder", 3)},
          {"block with a hole", read_body("block_with_hole", 3)},
          {"hollow sphere", read_body("hollow_sphere", 3)}};
}

}  // namespace
}  // namespace perilink::verification

bool perilink::verification::run_program(const std::vector<std::string>& arguments) {
  const std::string chosen = arguments.empty() ? "" : arguments[0];
  const int broken = arguments.size() > 1 ? std::stoi(arguments[1]) : 200;
  const std::filesystem::path directory = std::filesystem::temp_directory_path() / "round_off";
  std::string table = "body,particles,peak,scaled,moved,noisy,binary,renumbered,seconds\n";
  double largest = 0.0;
  for (const MeshBody& body : bodies()) {
    if (body.name.find(chosen) == std::string::npos) continue;
    const ChangedBody plain = run_changed(body, Change::none, broken, directory);
    fmt::print("{} ({}): peak {:.10g}, {:.3f} s, {} iterations, unbalanced {:.1e}\n", body.name,
               plain.model.network.particles.size(), plain.peak, plain.seconds,
               plain.model.network.report.calibration->iterations,
               plain.model.network.report.calibration->residual_after);
    table += fmt::format("\"{}\",{},{:.6g}", body.name, plain.model.network.particles.size(),
                         plain.peak);
    double seconds = plain.seconds;
    for (const Change change : all_changes) {
      const ChangedBody other = run_changed(body, change, broken, directory);
      const double peak = std::abs(other.peak / plain.peak - 1.0);
      const double weights = stiffness_difference(body, plain.model, other.model, change);
      fmt::print("  {}: stiffness {:.1e} peak {:.1e} {:.3f} s {} iterations\n",
                 static_cast<int>(change), weights, peak, other.seconds,
                 other.model.network.report.calibration->iterations);
      std::fflush(stdout);
      largest = std::max({largest, peak});
      table += fmt::format(",{:.0e}", peak);
      seconds = std::min(seconds, other.seconds);
    }
    table += fmt::format(",{:.3f}\n", seconds);
  }
  fmt::print("{}", table);
  if (chosen.empty()) write_result(PERILINK_STUDY_DIR, table);
  return largest < 1e-6;
}
