#include <fmt/format.h>

#include <string>
#include <vector>

#include "drift.hpp"
#include "network/rigid_modes.hpp"
#include "problems/block.hpp"
#include "problems/program.hpp"
#include "problems/result.hpp"
#include "problems/surface_option.hpp"

using namespace perilink;
using namespace perilink::verification;

namespace {

/// Runs the smallest block to its end and counts the parts of the body before and after the element
/// at which the analysis says that it separated.
bool collapse_is_separation(const std::string& surface) {
  const Model model = make_block(columns_5k, surface);
  const BlockRun run = run_block(model, FactorRoute::in_place, 1000000);
  Network network = model.network;
  const std::vector<std::uint8_t> held(model.unknowns.number.size(), 0);
  for (std::size_t k = 0; k + 1 < run.rows.size(); ++k) {
    network.stiffness[run.rows[k].element] = 0.0;
  }
  const std::size_t before = find_fragments(network, held).size();
  network.stiffness[run.rows.back().element] = 0.0;
  const std::size_t after = find_fragments(network, held).size();
  fmt::print(
      "collapse of the 5k block: ended {} after {} broken bonds; parts that bonds connect: {} "
      "before the last bond, {} after it\n",
      to_string(run.result.termination), run.result.broken_bonds, before, after);
  fmt::print("  {}\n", run.result.reason);
  return run.result.termination == Termination::collapsed;
}

bool run_study(const std::string& surface) {
  const Model model = make_block(columns_50k, surface);
  std::string table;
  bool good = true;
  fmt::print("{} unknowns, {} bonds\n", model.unknowns.count, model.network.num_elements());
  table += "downdates,residual,error,factor_error\n";
  fmt::print("{}", table);
  for (const auto& d : measure_drift(model, 20000, 2500)) {
    const std::string row =
        fmt::format("{},{:.2e},{:.2e},{:.2e}\n", d.downdates, d.residual, d.error, d.factor_error);
    fmt::print("{}", row);
    table += row;
    good = good && d.residual < 1e-10 && d.error < 1e-10;
  }
  fmt::print("particles,bonds,springs,error_of_the_rest\n");
  table += "particles,bonds,springs,error_of_the_rest\n";
  for (const double radius : {0.1, 1.1, 2.1}) {
    const Detachment d = measure_detachment(model, 40.0, 140.0, radius);
    const std::string row =
        fmt::format("{},{},{},{:.2e}\n", d.particles, d.bonds, d.springs, d.error);
    fmt::print("{}", row);
    table += row;
    good = good && d.error < 1e-12;
  }
  write_result(PERILINK_STUDY_DIR, table, result_file(surface));
  return collapse_is_separation(surface) && good;
}

}  // namespace

/// How accurate are factor and displacement after 20 000 downdates, and the rest of a body from
/// which a part was cut?
/// downdate_drift [--surface calibrated|none]
bool perilink::verification::run_program(const std::vector<std::string>& arguments) {
  std::vector<std::string> rest = arguments;
  return run_study(take_surface_option(rest));
}
