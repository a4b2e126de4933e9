#include "app/compare/comparison.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <string_view>

#include "app/compare/curve_distance.hpp"
#include "io/text/csv.hpp"

namespace perilink {
namespace {

constexpr double no_value = std::numeric_limits<double>::quiet_NaN();

/// Units of the compared quantities; all empty where they are unknown or differ.
struct Units {
  std::string force, length, stiffness, energy, volume;
};

Units units_of(const RunResult& a, const RunResult& b) {
  Units units;
  if (a.units != b.units) return units;
  units.force = a.labels.force;
  units.length = a.labels.length;
  if (units.force.empty() || units.length.empty()) return units;
  units.stiffness = units.force + "/" + units.length;
  units.energy = units.force + " " + units.length;
  units.volume = units.length + "³";
  return units;
}

/// Two results and their comparison.
struct Pair {
  const RunResult& a;
  const RunResult& b;
  Units units;
  Comparison found;

  bool has(std::string_view name) const {
    return std::any_of(found.quantities.begin(), found.quantities.end(),
                       [&](const ComparedQuantity& q) { return q.name == name; });
  }
  void add(std::string name, std::string unit, double of_a, double of_b) {
    found.quantities.push_back({std::move(name), std::move(unit), of_a, of_b, no_value});
  }
  void add_between(std::string name, std::string unit, double value) {
    found.quantities.push_back({std::move(name), std::move(unit), no_value, no_value, value});
  }
};

/// Returns the initial stiffness of the summary [force/length]. Without one: least squares over the
/// rows before the peak with at most a third of its load, or over the first row.
double initial_stiffness(const RunResult& result) {
  const double known = number_of(result.summary, "initial_stiffness");
  if (!std::isnan(known)) return known;
  const std::size_t peak = result.peak_number();
  const double limit = std::abs(result.records[peak].load) / 3.0;
  double products = 0.0, squares = 0.0;
  for (std::size_t k = 0; k < peak; ++k) {
    const StepRecord& record = result.records[k];
    if (std::abs(record.load) > limit) continue;
    products += record.load * record.displacement;
    squares += record.displacement * record.displacement;
  }
  if (squares > 0.0) return products / squares;
  const StepRecord& first = result.records.front();
  return first.displacement != 0.0 ? first.load / first.displacement : no_value;
}

void compare_curves(Pair& pair) {
  const StepRecord &peak_a = pair.a.peak(), &peak_b = pair.b.peak();
  pair.add("peak_load", pair.units.force, peak_a.load, peak_b.load);
  pair.add("peak_displacement", pair.units.length, peak_a.displacement, peak_b.displacement);
  pair.add("initial_stiffness", pair.units.stiffness, initial_stiffness(pair.a),
           initial_stiffness(pair.b));
  const std::vector<CurvePoint> path_a = path_of(pair.a.records), path_b = path_of(pair.b.records);
  const std::vector<CurvePoint> a = displacement_reading(path_a), b = displacement_reading(path_b);
  const double range = std::min(a.back().displacement, b.back().displacement);
  pair.add("largest_displacement", pair.units.length, a.back().displacement, b.back().displacement);
  pair.add("work_in_common_range", pair.units.energy, work_until(a, range), work_until(b, range));
  pair.add_between("load_distance", "%", 100.0 * load_distance(a, b, range));
  pair.add_between("path_distance", "%", 100.0 * path_distance(path_a, path_b));
}

/// Compares the last row of every energy and work column that either history has.
void compare_energies(Pair& pair) {
  for (const RunResult* result : {&pair.a, &pair.b}) {
    for (const auto& [name, value] : result->last_row) {
      if (pair.has(name)) continue;
      if (!name.ends_with("_energy") && !name.ends_with("_work")) continue;
      pair.add(name, pair.units.energy, number_of(pair.a.last_row, name),
               number_of(pair.b.last_row, name));
    }
  }
}

/// Compares gauges at the last row, and at the peak unless both histories have one row only.
void compare_gauges(Pair& pair) {
  const bool have_peaks = pair.a.records.size() > 1 || pair.b.records.size() > 1;
  for (const RunResult* result : {&pair.a, &pair.b}) {
    for (const auto& [name, value] : result->gauges) {
      const std::string key = "gauge." + name;
      if (pair.has(key + ".at_end")) continue;
      if (have_peaks) {
        pair.add(key + ".at_peak_load", "", number_of(pair.a.gauges_at_peak, name),
                 number_of(pair.b.gauges_at_peak, name));
      }
      pair.add(key + ".at_end", "", number_of(pair.a.gauges, name), number_of(pair.b.gauges, name));
    }
  }
}

void compare_cracks(Pair& pair) {
  const double tolerance = std::max(pair.a.horizon, pair.b.horizon);
  CrackOverlap cracks{no_value, no_value, no_value, no_value, no_value};
  if (pair.a.body && pair.b.body && pair.a.body->dim != pair.b.body->dim) {
    pair.found.notes.emplace_back(
        "one body is two-dimensional, the other three-dimensional: cracks are "
        "not compared");
  } else if (pair.a.body && pair.b.body && tolerance > 0.0) {
    cracks = crack_overlap(*pair.a.body, *pair.b.body, tolerance);
  }
  pair.add("cracked_volume", pair.units.volume, cracks.volume_a, cracks.volume_b);
  pair.add("cracked_near_other", "%", 100.0 * cracks.near_a, 100.0 * cracks.near_b);
  pair.add_between("crack_overlap", "%", 100.0 * cracks.overlap);
}

std::string unit_of(const std::string& key, const Units& units) {
  if (key.starts_with("seconds.")) return "s";
  if (key.ends_with("_bytes")) return "bytes";
  if (key == "spacing" || key == "horizon") return units.length;
  if (key.ends_with("_energy") || key.ends_with("_work")) return units.energy;
  return "";
}

/// Compares all other numbers of the summaries. The history gives the number of broken bonds where
/// the summaries lack it.
void compare_summaries(Pair& pair) {
  const auto value = [](const RunResult& result, const std::string& key) {
    const double known = number_of(result.summary, key);
    return std::isnan(known) ? number_of(result.last_row, key) : known;
  };
  pair.add("broken_bonds", "", value(pair.a, "broken_bonds"), value(pair.b, "broken_bonds"));
  pair.add("rows", "", static_cast<double>(pair.a.records.size()),
           static_cast<double>(pair.b.records.size()));
  for (const RunResult* result : {&pair.a, &pair.b}) {
    for (const auto& [key, number] : result->summary) {
      if (pair.has(key)) continue;
      pair.add(key, unit_of(key, pair.units), number_of(pair.a.summary, key),
               number_of(pair.b.summary, key));
    }
  }
}

/// Formats a number, "1.23457", or a dash for a missing one, aligned to the right.
std::string cell(double value) {
  return std::isnan(value) ? fmt::format("{:>14}", "-") : fmt::format("{:>14.6g}", value);
}

std::string percent_cell(double value) {
  if (std::isnan(value)) return fmt::format("{:>14}", "-");
  if (value == 0.0) return fmt::format("{:>14}", "0 %");
  // Round-off energies differ by any factor; large percentages must not run into the next column.
  return std::abs(value) < 1e6 ? fmt::format("{:>+12.2f} %", value)
                               : fmt::format("{:>+12.1e} %", value);
}

/// Turns "seconds.set_up" into "seconds set up".
std::string spaced(std::string name) {
  std::replace_if(
      name.begin(), name.end(), [](char c) { return c == '_' || c == '.'; }, ' ');
  return name;
}

/// Counts the characters of a UTF-8 text.
std::size_t shown_length(std::string_view text) {
  return static_cast<std::size_t>(std::count_if(
      text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) >> 6) != 2; }));
}

}  // namespace

double ComparedQuantity::difference_percent() const {
  if (a == b) return 0.0;
  // After separation values are round-off; a ratio to them means nothing.
  constexpr double round_off = 1e-9;
  return std::abs(a) <= round_off * std::abs(b) ? no_value : 100.0 * (b - a) / std::abs(a);
}

Comparison compare_results(const RunResult& a, const RunResult& b) {
  Pair pair{a, b, units_of(a, b), {}};
  for (const std::string& note : a.notes) pair.found.notes.push_back("A: " + note);
  for (const std::string& note : b.notes) pair.found.notes.push_back("B: " + note);
  if (!a.units.empty() && !b.units.empty() && a.units != b.units) {
    pair.found.notes.push_back(fmt::format(
        "the units differ, \"{}\" and \"{}\": numbers are compared as they are", a.units, b.units));
  }
  compare_curves(pair);
  compare_energies(pair);
  compare_gauges(pair);
  compare_cracks(pair);
  compare_summaries(pair);
  return std::move(pair.found);
}

std::string comparison_report(const RunResult& a, const RunResult& b,
                              const Comparison& comparison) {
  std::string text;
  for (const auto& [letter, result] : {std::pair('A', &a), std::pair('B', &b)}) {
    text += fmt::format("{}  {}: {}{}\n", letter, result->directory, result->labels.title,
                        result->status.empty() ? "" : " (" + result->status + ")");
  }
  text += fmt::format("\n{:<34}{:>14}{:>14}{:>14}\n", "", "A", "B", "difference");
  for (const ComparedQuantity& q : comparison.quantities) {
    const std::string name = with_unit(spaced(q.name), q.unit == "%" ? "" : q.unit);
    const std::string blanks(std::max<std::size_t>(34, shown_length(name) + 1) - shown_length(name),
                             ' ');
    if (!std::isnan(q.between)) {
      text += fmt::format("{}{}{:>40.2f} %\n", name, blanks, q.between);
      continue;
    }
    text += fmt::format("{}{}{}{}{}\n", name, blanks, cell(q.a), cell(q.b),
                        percent_cell(q.difference_percent()));
  }
  for (const std::string& note : comparison.notes) text += fmt::format("note: {}\n", note);
  return text;
}

std::string comparison_csv(const RunResult& a, const RunResult& b, const Comparison& comparison) {
  CsvRow header;
  std::string table = header.text("quantity")
                          .text("unit")
                          .text("a")
                          .text("b")
                          .text("difference_percent")
                          .text("between")
                          .end();
  const auto texts = [&](const char* name, const std::string& of_a, const std::string& of_b) {
    CsvRow row;
    table += row.text(name).empty().text(of_a).text(of_b).empty().empty().end();
  };
  texts("directory", a.directory, b.directory);
  texts("title", a.labels.title, b.labels.title);
  texts("status", a.status, b.status);
  for (const ComparedQuantity& q : comparison.quantities) {
    CsvRow row;
    row.text(q.name).text(q.unit).number(q.a).number(q.b);
    table += row.number(q.difference_percent()).number(q.between).end();
  }
  return table;
}

}  // namespace perilink
