#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <utility>
#include <vector>

#include "finding.hpp"
#include "io/text/csv.hpp"
#include "problems/program.hpp"
#include "problems/result.hpp"

namespace perilink::verification {
namespace {

std::string table_of(const Findings& findings) {
  std::string table = "part,body,quantity,measured,reference,ratio,allowed\n";
  for (const Finding& f : findings) {
    const auto text = [](double value) { return value == 0.0 ? "" : fmt::format("{:.4g}", value); };
    const double ratio = f.reference == 0.0 ? 0.0 : f.measured / f.reference;
    table += CsvRow().text(f.part).text(f.body).text(f.quantity).end();
    table.pop_back();
    table += fmt::format(",{:.4g},{},{},{}\n", f.measured, text(f.reference), text(ratio),
                         text(f.allowed));
  }
  return table;
}

}  // namespace

/// All parts of the study, or those whose numbers are given: writes the pictures and, of all parts,
/// result.csv.
bool run_program(const std::vector<std::string>& arguments) {
  const std::vector<std::pair<std::string, Findings (*)()>> parts{
      {"1", bend_on_four_points}, {"2", push_cantilever},       {"3", pull_tension_members},
      {"4", pull_bar_out},        {"5", crush_over_reinforced}, {"5", shear_short_beams},
      {"6", bend_measured_beam}};
  Findings findings;
  for (const auto& [part, run] : parts) {
    if (!arguments.empty() && std::ranges::find(arguments, part) == arguments.end()) continue;
    const Findings found = run();
    fmt::print("{}", table_of(found));
    std::fflush(stdout);
    findings.insert(findings.end(), found.begin(), found.end());
  }
  if (arguments.empty()) write_result(PERILINK_STUDY_DIR, table_of(findings));
  bool met = true;
  for (const Finding& f : findings) {
    if (f.allowed > 0.0) met = met && std::abs(f.measured / f.reference - 1.0) <= f.allowed;
  }
  return met;
}

}  // namespace perilink::verification
