#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <string>
#include <vector>

#include "compare.hpp"
#include "problems/block.hpp"
#include "problems/program.hpp"
#include "problems/result.hpp"
#include "problems/surface_option.hpp"
#include "softening.hpp"

namespace perilink::verification {
namespace {

/// \return whether all sizes meet the acceptance
bool run_sizes(const std::string& surface, bool quick) {
  struct Size {
    int columns;
    Index events, reference_events;
  };
  const Size sizes[] = {
      {columns_5k, 1000, 1000}, {columns_50k, 1000, 500}, {columns_300k, 1000, 40}};
  std::string table =
      "columns,unknowns,events,ending,compared,mismatches,load_factor_difference,energy_error,"
      "largest_residual,factorizations,seconds,reference_seconds\n";
  fmt::print("{}", table);
  bool good = true;
  for (const Size& size : sizes) {
    const Agreement a = compare_routes(make_block(size.columns, surface), FactorRoute::refactorize,
                                       size.events, size.reference_events);
    const std::string row = fmt::format(
        "{},{},{},{},{},{},{:.2e},{:.2e},{:.2e},{},{:.2f},{:.2f}\n", size.columns, a.unknowns,
        a.events, a.termination, a.compared, a.mismatches, a.load_factor_difference, a.energy_error,
        a.largest_residual, a.factorizations, a.seconds, a.other_seconds);
    fmt::print("{}", row);
    std::fflush(stdout);
    table += row;
    good = good && a.mismatches == 0 && a.load_factor_difference < 1e-9 && a.energy_error < 1e-9;
    if (quick) break;
  }
  if (!quick) write_result(PERILINK_STUDY_DIR, table, result_file(surface));
  return good;
}

}  // namespace
}  // namespace perilink::verification

/// Is every event of the downdated factor the event that a run breaks which factorises anew each
/// time? exact_events [--surface calibrated|none] [--quick]: quick is the smallest size only;
/// exact_events --softening [large]: bonds that soften.
bool perilink::verification::run_program(const std::vector<std::string>& arguments) {
  if (!arguments.empty() && arguments.front() == "--softening") {
    return run_softening(arguments.back() == "large");
  }
  std::vector<std::string> rest = arguments;
  const std::string surface = take_surface_option(rest);
  return run_sizes(surface, std::find(rest.begin(), rest.end(), "--quick") != rest.end());
}
