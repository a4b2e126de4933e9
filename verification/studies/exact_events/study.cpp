#include <fmt/format.h>

#include <cstdio>
#include <cstring>
#include <string>

#include "compare.hpp"
#include "problems/block.hpp"
#include "problems/result.hpp"

/// Is every event of the downdated factor the event that a run breaks which factorises anew each time?
/// exact_events [--quick]: the smallest size only.
int main(int argc, char** argv) {
  using namespace perilink;
  using namespace perilink::verification;
  const bool quick = argc > 1 && std::strcmp(argv[1], "--quick") == 0;
  struct Size {
    int columns;
    Index events, reference_events;
  };
  const Size sizes[] = {{columns_5k, 1000, 1000}, {columns_50k, 1000, 200}, {columns_300k, 1000, 20}};
  std::string table =
      "columns,unknowns,events,ending,compared,mismatches,load_factor_difference,energy_error,"
      "largest_residual,factorizations,seconds,reference_seconds\n";
  fmt::print("{}", table);
  bool good = true;
  for (const Size& size : sizes) {
    const Agreement a = compare_routes(size.columns, FactorRoute::refactorize, size.events,
                                       size.reference_events);
    const std::string row = fmt::format(
        "{},{},{},{},{},{},{:.2e},{:.2e},{:.2e},{},{:.2f},{:.2f}\n", a.columns, a.unknowns, a.events,
        a.ending, a.compared, a.mismatches, a.load_factor_difference, a.energy_error,
        a.largest_residual, a.factorizations, a.seconds, a.other_seconds);
    fmt::print("{}", row);
    std::fflush(stdout);
    table += row;
    good = good && a.mismatches == 0 && a.load_factor_difference < 1e-9 && a.energy_error < 1e-9;
    if (quick) break;
  }
  if (!quick) write_result(PERILINK_STUDY_DIR, table);
  return good ? 0 : 1;
}
