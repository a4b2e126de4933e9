#include "app/report/report_units.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "io/text/input_text.hpp"
#include "results/history_columns.hpp"

namespace perilink {
namespace {

/// Ends of names and what their units are made of: force F, length L, time T. The first that fits
/// counts.
using Ending = std::pair<std::string_view, std::string_view>;
constexpr auto endings = std::to_array<Ending>({
    {"strain_energy_density", "F/L²"},
    {"fracture_energy", "F/L"},
    {"crushing_energy", "F/L"},
    {"_energy", "F L"},
    {"external_work", "F L"},
    {"youngs_modulus", "F/L²"},
    {"hardening_modulus", "F/L²"},
    {"strength", "F/L²"},
    {"stress", "F/L²"},
    {"traction", "F/L²"},
    {"pressure", "F/L²"},
    {"largest_compression", "F/L²"},
    {"initial_stiffness", "F/L"},
    {"bond_stiffness", "F/L³"},
    {"body_force", "F/L³"},
    {"moment", "F L"},
    {"force", "F"},
    {"load_factor", ""},
    {"load", "F"},
    {"reaction", "F"},
    {"displacement", "L"},
    {"displacement_error", ""},
    {"opening", "L"},
    {"slip", "L"},
    {"distance", "L"},
    {"spacing", "L"},
    {"horizon", "L"},
    {"thickness", "L"},
    {"radius", "L"},
    {"perimeter", "L"},
    {"cover", "L"},
    {"size", "L"},
    {"offset", "L"},
    {"points", "L"},
    {"corners", "L"},
    {"between", "L"},
    {"from", "L"},
    {"to", "L"},
    {"widest_at", "L"},
    {"middle", "L"},
    {"length", "L"},
    {"buffer_zone", "L"},
    {"area", "L²"},
    {"volume", "L³"},
    {"velocity", "L/T"},
    {"duration", "T"},
    {"ramp_time", "T"},
    {"time_step", "T"},
    {"fundamental_period", "T"},
    {"fields_times", "T"},
    {"time", "T"},
});

/// Returns a product of units such as "F/L"; empty where the unit of a part is unknown.
std::string in_units(std::string_view dimension, const UnitNames& units) {
  std::string unit;
  for (const char letter : dimension) {
    const std::string* part = letter == 'F'   ? &units.force
                              : letter == 'L' ? &units.length
                              : letter == 'T' ? &units.time
                                              : nullptr;
    if (part != nullptr && part->empty()) return "";
    unit += part != nullptr ? *part : std::string(1, letter);
  }
  return unit;
}

}  // namespace

UnitNames UnitNames::of(const std::string& units) {
  UnitNames names;
  std::size_t begin = 0;
  for (std::string* part : {&names.force, &names.length, &names.time}) {
    if (begin > units.size()) break;
    const std::size_t end = std::min(units.find(',', begin), units.size());
    *part = trimmed(std::string_view(units).substr(begin, end - begin));
    begin = end + 1;
  }
  return names;
}

std::string unit_of_quantity(std::string_view name, const UnitNames& units) {
  const auto found = std::ranges::find_if(
      endings, [&](const auto& ending) { return name.ends_with(ending.first); });
  return found == endings.end() ? "" : in_units(found->second, units);
}

std::string unit_of_column(const std::string& name, const TomlValue& root, const UnitNames& units) {
  const HistoryColumn* column = find_history_column(name);
  if (column != nullptr) return in_units(column->unit, units);
  const TomlValue* gauges = root.find("gauges");
  for (const TomlValue& gauge : gauges == nullptr ? std::vector<TomlValue>{} : gauges->items) {
    const TomlValue* known = gauge.find("name");
    if (known == nullptr || known->text != name) continue;
    if (gauge.find("cracks") != nullptr) {
      const TomlValue* body = root.find("body");
      const TomlValue* problem = body == nullptr ? nullptr : body->find("problem");
      const bool in_space = problem != nullptr && problem->text == "three_dimensional";
      return in_units(in_space ? "L²" : "L", units);
    }
    const char* measured = gauge.find("stress") != nullptr     ? "stress"
                           : gauge.find("about") != nullptr    ? "moment"
                           : gauge.find("reaction") != nullptr ? "force"
                                                               : "displacement";
    return unit_of_quantity(measured, units);
  }
  return "";
}

std::string in_words(std::string_view name) {
  std::string words(name);
  std::ranges::replace(words, '_', ' ');
  return words;
}

}  // namespace perilink
