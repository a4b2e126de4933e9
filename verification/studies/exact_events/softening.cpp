#include "softening.hpp"

#include <fmt/format.h>

#include <cstdio>
#include <limits>
#include <string>
#include <vector>

#include "compare.hpp"
#include "problems/block.hpp"
#include "problems/result.hpp"

namespace perilink::verification {
namespace {

struct Body {
  int columns;
  bool micropolar, softens;
  std::size_t events;    ///< at most
  std::size_t compared;  ///< with fresh factors
};

/// Concrete with a process zone E G_F / f_t^2 of 22.5 in, twice the coarser horizon.
Model model_of(const Body& body) {
  return build_model(parse_case(
      block_case({.title = "Block",
                  .layout = fmt::format(
                      "pattern = \"hexagonal\"\ncolumns = {}\nhorizon_ratio = 3.0", body.columns),
                  .surface = "calibrated",
                  .poissons_ratio = body.micropolar ? 0.2 : 0.0,
                  .tensile_strength = body.softens ? 0.4 : 0.0}),
      "block"));
}

}  // namespace

bool run_softening(bool large) {
  // Columns that give 5 000 and 50 000 unknowns, with moments fewer. Brittle bonds are there for
  // their times alone: the other table compares them.
  const std::vector<Body> small = {{columns_5k, false, false, 3000, 1},
                                   {columns_5k, false, true, 3000, 3000},
                                   {22, true, false, 3000, 1},
                                   {22, true, true, 3000, 3000}};
  const std::vector<Body> fine = {{columns_50k, false, false, 500, 1},
                                  {columns_50k, false, true, 500, 500},
                                  {70, true, false, 500, 1},
                                  {70, true, true, 500, 500}};
  std::string table =
      "model,law,columns,unknowns,events,ending,compared,mismatches,load_factor_difference,"
      "energy_error,largest_residual,factorizations,ms_per_event\n";
  fmt::print("{}", table);
  bool good = true;
  for (const Body& body : large ? fine : small) {
    constexpr Index bonds = std::numeric_limits<Index>::max();
    const Agreement a = compare_routes(model_of(body), FactorRoute::refactorize, bonds, bonds,
                                       body.events, body.compared);
    const std::string row = fmt::format(
        "{},{},{},{},{},{},{},{},{:.2e},{:.2e},{:.2e},{},{:.3f}\n",
        body.micropolar ? "micropolar" : "bond_based", body.softens ? "bilinear" : "brittle",
        body.columns, a.unknowns, a.rows, a.termination, a.compared, a.mismatches,
        a.load_factor_difference, a.energy_error, a.largest_residual, a.factorizations,
        1e3 * a.seconds_per_event);
    fmt::print("{}", row);
    std::fflush(stdout);
    table += row;
    write_result(PERILINK_STUDY_DIR, table,
                 large ? "result_softening_50k.csv" : "result_softening.csv");
    good = good && a.mismatches == 0 && a.load_factor_difference < 1e-9 && a.energy_error < 1e-9;
  }
  return good;
}

}  // namespace perilink::verification
