#include "io/case/sections/case_sections.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "io/case/binding/key_binding.hpp"
#include "io/case/sections/laws/case_interfaces.hpp"

namespace perilink {
CrackSection read_crack(const CaseTable& table, Kinds kind) {
  auto crack = read_section<CrackSection>("cracks", table, kind);
  read_face(table, dimension_of(kind), crack.points, crack.group);
  return crack;
}

void check_load_factors(const CaseTable& table, const std::vector<double>& factors) {
  if (factors.empty()) table.refuse("load_factors", "is empty", "give one number for each step");
  if (std::ranges::any_of(factors, [](double factor) { return factor != 0.0; })) return;
  table.refuse("load_factors", "holds only zeros, so no step loads the body",
               "give one number for each step: [0.1, 0.2, 0.3]");
}

AnalysisSection read_analysis(const CaseTable& table, Kinds kind) {
  auto analysis = read_section<AnalysisSection>("analysis", table, kind);
  const bool relaxes = analysis.type == AnalysisType::relaxation;
  if (!table.has("ramp_time")) analysis.ramp_time = analysis.duration;
  if (analysis.type == AnalysisType::elastic || relaxes) {
    analysis.tolerance = analysis.tolerance.value_or(relaxes ? 1e-6 : 1e-10);
  }
  const bool given = table.has("load_factors");
  const bool steps = analysis.control == LoadControl::steps;
  if (steps && !given) {
    table.refuse_missing("load_factors", "the load factors of the steps: [0.1, 0.2, 0.3]");
  }
  if (analysis.type == AnalysisType::damage && given && !steps) {
    table.refuse("load_factors", "is given, but control = \"events\" finds the load factors itself",
                 "set control = \"steps\", or delete `load_factors`");
  }
  if (relaxes && !given) analysis.load_factors = {1.0};
  if (given) check_load_factors(table, *table.numbers("load_factors"));
  return analysis;
}

void check_rules_of_gauge(const CaseTable& table) {
  if (table.has("gauge")) table.need_one_of({"above", "below"});
}

StopSection read_stop(const CaseTable& table, Kinds kind) {
  const auto stop = read_section<StopSection>("stop", table, kind);
  check_rules_of_gauge(table);
  return (kind & kinds::elastic) != 0 ? StopSection{} : stop;
}

}  // namespace perilink
