#include <fmt/format.h>

#include <cstdio>
#include <stdexcept>
#include <string>

#include "problems/program.hpp"
#include "problems/result.hpp"
#include "stability.hpp"

namespace perilink::verification {
namespace {

std::string row(const MovingBody& body, double factor, bool refuse) {
  const std::string name =
      fmt::format("{},{},{:.4g},{}", body.name, body.cracks ? "cracks" : "elastic", factor,
                  refuse ? "refuses" : "goes on");
  try {
    const ExplicitResult result = run_at(body, factor, refuse);
    return fmt::format("{},{},{},{:.1e},{},{}\n", name, to_string(result.termination), result.steps,
                       result.largest_surplus,
                       result.last.broken_bonds + result.last.cracked_particles,
                       is_finite(result.last) ? "finite" : "not finite");
  } catch (const std::invalid_argument&) {
    return name + ",refused,0,,0,\n";
  }
}

/// Step over the computed critical one from which the motion is seen to grow, to 1 %.
double limit_of_growth(const MovingBody& body) {
  double stable = 1.0, grows = 2.0;
  while (grows - stable > 0.01) {
    const double factor = 0.5 * (stable + grows);
    const bool failed = run_at(body, factor, false).termination == Termination::failed;
    (failed ? grows : stable) = factor;
  }
  return grows;
}

}  // namespace

/// Which steps are stable, and what becomes of those that are not? Writes result.csv.
bool run_program(const std::vector<std::string>& /*arguments*/) {
  std::string table =
      "bonds,material,step_over_critical,above_critical,ending,steps,energy_surplus,cracked,"
      "last_row\n";
  for (const MovingBody& body : moving_bodies()) {
    for (const double factor : {0.5, 0.9, 0.99, 1.01}) table += row(body, factor, true);
    table += row(body, 1.01, false);
    if (!body.cracks) table += row(body, limit_of_growth(body), false);
    table += row(body, 2.0, false);
  }
  fmt::print("{}", table);
  write_result(PERILINK_STUDY_DIR, table);
  return true;
}

}  // namespace perilink::verification
