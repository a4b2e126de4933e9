// The linear patch test of calibrated bonds on every lattice and on meshes.
//
//   patch_tests [DIRECTORY]    writes result.csv and residuals.svg there or in the study's folder
//
// Exit status 1 when a body misses the acceptance.

#include <fmt/format.h>

#include <cstdio>
#include <string>
#include <vector>

#include "base/timer.hpp"
#include "draw.hpp"
#include "patch.hpp"
#include "problems/program.hpp"
#include "problems/result.hpp"

namespace perilink::verification {
namespace {

bool run_study(const std::string& directory) {
  std::string table =
      "body,dimension,micropolar,particles,bonds,before,force,unmet_particles,x,y,z,moment,"
      "traction_error,displacement_error\n";
  fmt::print("{}", table);
  std::vector<PatchResult> results;
  bool good = true;
  for (const PatchBody& body : patch_bodies()) {
    const Timer timer;
    const PatchResult r = run_patch(body);
    const std::string row =
        fmt::format("{},{},{},{},{},{:.1e},{:.1e},{},{:.3g},{:.3g},{:.3g},{:.1e},{:.1e},{:.1e}\n",
                    body.name, body.dim, body.micropolar ? 1 : 0, r.particles, r.bonds, r.before,
                    r.residual.force, r.residual.particles, r.residual.at[0], r.residual.at[1],
                    r.residual.at[2], r.residual.moment, r.traction_error, r.displacement_error);
    fmt::print("{}", row);
    fmt::print(stderr, "{}: {:.1f} s\n", body.name, timer.seconds());
    std::fflush(stdout);
    table += row;
    results.push_back(r);
    good = good && meets_acceptance(r);
  }
  write_result(directory, table);
  draw_residuals(results).save(directory + "/residuals.svg");
  return good;
}

}  // namespace
}  // namespace perilink::verification

bool perilink::verification::run_program(const std::vector<std::string>& arguments) {
  return run_study(arguments.empty() ? PERILINK_STUDY_DIR : arguments[0]);
}
