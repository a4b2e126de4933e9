// [[gauges]] of a case.

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <vector>

#include "base/plain_text.hpp"
#include "io/case/binding/key_binding.hpp"
#include "io/case/case_schema.hpp"
#include "io/case/case_words.hpp"
#include "io/case/sections/case_gauges.hpp"
#include "io/case/sections/case_kinds.hpp"
#include "io/case/sections/case_sections.hpp"

namespace perilink {
namespace {

/// Names are column headings, where a leading minus sign would begin a formula, and file names of
/// pictures.
bool is_plain(const std::string& name) {
  const auto plain = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
           c == '-';
  };
  return !name.empty() && name[0] != '-' && std::all_of(name.begin(), name.end(), plain);
}

std::vector<std::string_view> stress_names(int dim) {
  if (dim == 2) return {"xx", "yy", "xy"};
  return {"xx", "yy", "zz", "xy", "yz", "xz"};
}

/// Checks the keys beside `reaction`. Moments turn about one axis in the plane, but about three on
/// shells.
void read_reaction(const CaseTable& table, Kinds kind, const GaugeSection& gauge) {
  if (table.has("stress")) {
    table.refuse("stress", "is given together with `reaction`", "give `axis` for a force");
  }
  const bool in_plane = (kind & kinds::plane) != 0;
  if (gauge.about && in_plane) {
    if (table.has("axis")) {
      table.refuse("axis", "is given together with `about`",
                   "a moment in the plane turns in it; delete one of the two");
    }
  } else {
    const std::string choices = in_plane ? "x or y" : "x, y or z";
    table.need("axis", table.text("axis"),
               gauge.about ? "the axis of the moment: " + choices : choices);
  }
}

}  // namespace

std::string stress_name(const std::array<int, 2>& axes) {
  return std::string(axis_names[axes[0]]) + axis_names[axes[1]];
}

GaugeSection read_gauge(const CaseTable& table, Kinds kind) {
  const int dim = dimension_of(kind);
  const auto stress = table.choice("stress", stress_names(dim));  // fewer words than the row has
  auto gauge = read_section<GaugeSection>("gauges", table, kind);
  if (!is_plain(gauge.name)) {
    table.refuse("name", fmt::format("is {}", quoted(gauge.name)),
                 "use letters, digits, _ and - (not as the first), since it heads a column");
  }
  if (table.has("between") && gauge.between.size() != 2) {
    table.refuse("between", "holds " + counted(gauge.between.size(), "point"),
                 "give two: [[0, 0], [0, 1]]");
  }
  if (table.has("cracks")) {
    if ((kind & (kinds::lattice | kinds::particles | kinds::elements | kinds::beam)) != 0) {
      table.refuse("cracks", "is given, but only bonds of a solid measure cracks",
                   "delete the gauge, or choose another model in [body]");
    }
    for (const char* key : {"axis", "stress"}) {
      if (table.has(key)) table.refuse(key, "is given together with `cracks`", "delete it");
    }
  } else if (table.has("reaction")) {
    read_reaction(table, kind, gauge);
  } else if (table.has("between")) {
    if (table.has("stress")) {
      table.refuse("stress", "is given together with `between`",
                   "measure a stress `at` a point or in a `region`");
    }
  } else {
    table.need_one_of({"axis", "stress"});
  }
  if (stress) gauge.stress = {(*stress)[0] - 'x', (*stress)[1] - 'x'};
  return gauge;
}

namespace {

/// Refuses stresses where they are not computed: Green strains, and state-based particles in
/// motion.
void refuse_stress(const CaseFile& input, const std::string& key) {
  const AnalysisType type = input.analysis.type;
  if (type == AnalysisType::elastic) return;
  if (has_state_based_particles(input.body)) {
    throw InputError(input.where(key),
                     fmt::format("is given, but analysis.type is \"{}\": stresses of state-based "
                                 "particles need an elastic analysis",
                                 word_of(type)),
                     "measure a displacement, or set analysis.type = \"elastic\"");
  }
  if (!is_quasistatic(type) && input.analysis.strain == Strain::green) {
    throw InputError(input.where(key),
                     "is given, but analysis.strain is \"green\", whose forces turn with the body",
                     "measure a displacement, or set strain = \"small\"");
  }
}

}  // namespace

namespace {

/// \param table  "stop" or "stages[2]"
void check_rule(const CaseFile& input, const StopSection& stop, const std::string& table) {
  if (stop.gauge.empty()) return;
  std::vector<std::string_view> names;
  for (const GaugeSection& gauge : input.gauges) names.push_back(gauge.name);
  if (std::ranges::find(names, stop.gauge) != names.end()) return;
  throw InputError(input.where(table + ".gauge"),
                   fmt::format("is {}, but no gauge has this name", quoted(stop.gauge)),
                   names.empty() ? "add [[gauges]] with this name" : suggest(stop.gauge, names));
}

}  // namespace

void check_gauges(const CaseFile& input) {
  check_rule(input, input.stop, "stop");
  for (std::size_t k = 0; k < input.stages.size(); ++k) {
    check_rule(input, input.stages[k].stop, item_key("stages", k));
  }
  for (std::size_t k = 0; k < input.gauges.size(); ++k) {
    const GaugeSection& gauge = input.gauges[k];
    const auto named = [&](const GaugeSection& other) { return other.name == gauge.name; };
    const auto first = std::find_if(input.gauges.begin(), input.gauges.end(), named);
    if (first - input.gauges.begin() != static_cast<std::ptrdiff_t>(k)) {
      throw InputError(input.where(item_key("gauges", k, "name")),
                       fmt::format("is {}, the name of another gauge", quoted(gauge.name)),
                       "give every gauge a different name");
    }
    if (gauge.stress) refuse_stress(input, item_key("gauges", k, "stress"));
  }
}

}  // namespace perilink
