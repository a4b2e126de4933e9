#include "io/case/sections/laws/case_softening.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <string>
#include <string_view>
#include <vector>

#include "io/case/case_words.hpp"

namespace perilink {
namespace {

/// Largest ratio of the stretch at zero force to the stretch at the peak.
constexpr double most_rise = 1e10;
constexpr std::array knee_keys = {"knee_stress_ratio", "knee_opening_ratio"};
constexpr std::array concrete_keys = {"tension_limit", "tension_factor", "compression_limit",
                                      "compression_factor", "shear_softening"};
constexpr std::array other_keys = {"tensile_strength", "softening_stretches", "fracture_energy",
                                   "softening_points", "knee_stress_ratio",   "knee_opening_ratio"};
constexpr std::array keys = {
    "softening",        "closing",         "tensile_strength",  "softening_stretches",
    "softening_points", "softening_error", "knee_stress_ratio", "knee_opening_ratio",
    "tension_limit",    "tension_factor",  "compression_limit", "compression_factor",
    "shear_softening"};

/// Returns the first given key, or nullptr.
template <std::size_t count>
const char* find_given(const CaseTable& table, const std::array<const char*, count>& names) {
  for (const char* key : names) {
    if (table.has(key)) return key;
  }
  return nullptr;
}

std::array<double, 2> read_stretches(const CaseTable& table, Softening kind) {
  const std::string key = "softening_stretches";
  const auto given = table.numbers(key);
  if (!given) return {};
  if (kind == Softening::exponential) {
    table.refuse(key, "is given, but an exponential curve has no end",
                 "give `tensile_strength` and `fracture_energy`");
  }
  if (table.has("fracture_energy")) {
    table.refuse("fracture_energy", "is given together with `softening_stretches`",
                 "delete one of the two: the stretches determine the energy");
  }
  if (given->size() != 2 || !((*given)[0] > 0.0) || !((*given)[1] > (*given)[0]) ||
      !((*given)[1] <= most_rise * (*given)[0])) {
    table.refuse(key, fmt::format("must be two stretches that rise, {:g} times at most", most_rise),
                 "give where the force of a bond begins to fall and where it has fallen to zero: "
                 "[1e-4, 1e-3]");
  }
  return {(*given)[0], (*given)[1]};
}

/// Reads openings and stresses of a curve, in any units.
/// \return points as in SofteningShape
std::vector<std::array<double, 2>> read_points(const CaseTable& table, Softening kind) {
  const std::string key = "softening_points";
  const std::string example =
      "give [opening, stress] from the strength down to zero: "
      "[[0, 3], [0.02, 1], [0.1, 0]]";
  if (kind != Softening::points) {
    if (table.has(key)) {
      table.refuse(key, "is given, but softening is not \"points\"",
                   "delete it, or set softening = \"points\"");
    }
    return {};
  }
  const std::vector<Vector3> given =
      table.need(key, table.vectors(key, 2), "points of the curve of stress over opening");
  const bool has_ends = given.size() >= 2 && given.front()[0] == 0.0 && given.front()[1] > 0.0 &&
                        given.back()[1] == 0.0;
  if (!has_ends)
    table.refuse(key, "must begin at the opening 0, with a stress, and end at the stress 0",
                 example);
  const double largest = given.back()[0], strength = given.front()[1];
  std::vector<std::array<double, 2>> points;
  for (std::size_t k = 1; k < given.size(); ++k) {
    const auto& [opening, stress, unused] = given[k];
    const bool is_last = k + 1 == given.size();
    if (!(opening > given[k - 1][0] && stress <= given[k - 1][1] && (is_last || stress > 0.0))) {
      table.refuse(
          key,
          fmt::format("has the point [{}, {}] after [{}, {}]: openings must rise, stresses "
                      "must not, and are zero at the last opening only",
                      opening, stress, given[k - 1][0], given[k - 1][1]),
          example);
    }
    if (!is_last) points.push_back({opening / largest, stress / strength});
  }
  return points;
}

void refuse_beside_brittle(const CaseTable& table) {
  for (const char* key : keys) {
    const bool its_own = std::string_view(key) == "softening" || std::string_view(key) == "closing";
    if (its_own || !table.has(key)) continue;
    table.refuse(
        key, "is given, but the bonds are brittle",
        "delete it, or set softening = \"linear\", \"bilinear\", \"exponential\" or "
        "\"points\": the strength of brittle bonds follows from fracture_energy and the horizon");
  }
}

/// Reads the stretch at which the force stops growing, and the larger stretch at which it falls to
/// zero.
std::array<double, 2> read_plateau(const CaseTable& table, const std::string& sense) {
  const std::string factor_key = sense + "_factor";
  const double limit = table.need(sense + "_limit", table.number(sense + "_limit"),
                                  "the stretch at which the force of a bond ceases to grow");
  const double factor = table.need(factor_key, table.number(factor_key),
                                   "the stretch at which it falls to zero over that limit");
  return {limit, factor * limit};
}

void read_concrete(const CaseTable& table, SofteningMaterial& material) {
  if (const char* key = find_given(table, other_keys)) {
    table.refuse(key, "is given, but softening = \"concrete\" has limits that determine the law",
                 "delete it; `check` prints the strengths and the fracture energy");
  }
  if (material.closes) {
    table.refuse("closing", "is true, but bonds with softening = \"concrete\" do not close",
                 "delete it");
  }
  material.stretches = read_plateau(table, "tension");
  material.crushing = read_plateau(table, "compression");
  assign(material.shear_softens, table.boolean("shear_softening"));
}

}  // namespace

SofteningMaterial read_softening(const CaseTable& table) {
  SofteningMaterial material;
  const auto closes = table.boolean("closing");
  const auto kind = table.choice<Softening>("softening");
  const bool named = kind || table.has("tensile_strength") || table.has("softening_stretches");
  material.shape.kind = kind.value_or(named ? Softening::bilinear : Softening::brittle);
  assign(material.error, table.number("softening_error"));
  const bool concrete = material.shape.kind == Softening::concrete;
  material.closes = closes.value_or(material.shape.kind != Softening::brittle && !concrete);
  if (material.shape.kind == Softening::brittle) {
    refuse_beside_brittle(table);
    return material;
  }
  if (concrete) {
    read_concrete(table, material);
    return material;
  }
  if (const char* key = find_given(table, concrete_keys)) {
    table.refuse(key, "is given, but only softening = \"concrete\" has it", "delete it");
  }
  table.need_one_of({"tensile_strength", "softening_stretches"});
  assign(material.tensile_strength, table.number("tensile_strength"));
  material.stretches = read_stretches(table, material.shape.kind);
  material.shape.points = read_points(table, material.shape.kind);
  const char* knee = find_given(table, knee_keys);
  if (knee && material.shape.kind != Softening::bilinear) {
    table.refuse(knee, "is given, but only bilinear softening has a knee",
                 "delete it, or set softening = \"bilinear\"");
  }
  assign(material.shape.knee_force, table.number("knee_stress_ratio"));
  assign(material.shape.knee_stretch, table.number("knee_opening_ratio"));
  return material;
}

void write_softening(TomlWriter& out, const SofteningMaterial& material) {
  if (material.closes || material.shape.kind != Softening::brittle) {
    out.write("closing", material.closes);
  }
  if (material.shape.kind == Softening::brittle) return;
  out.write("softening", word_of(material.shape.kind));
  if (material.shape.kind == Softening::concrete) {
    out.write("tension_limit", material.stretches[0]);
    out.write("tension_factor", material.stretches[1] / material.stretches[0]);
    out.write("compression_limit", material.crushing[0]);
    out.write("compression_factor", material.crushing[1] / material.crushing[0]);
    out.write("shear_softening", material.shear_softens);
  } else if (has_stretches(material)) {
    out.write("softening_stretches",
              std::vector<double>(material.stretches.begin(), material.stretches.end()));
  } else {
    out.write("tensile_strength", material.tensile_strength);
  }
  out.write("softening_error", material.error);
  if (material.shape.kind == Softening::points) {
    std::vector<std::vector<double>> points = {{0.0, 1.0}};
    for (const auto& [opening, stress] : material.shape.points) points.push_back({opening, stress});
    points.push_back({1.0, 0.0});
    out.write("softening_points", points);
  }
  if (material.shape.kind != Softening::bilinear) return;
  out.write("knee_stress_ratio", material.shape.knee_force);
  out.write("knee_opening_ratio", material.shape.knee_stretch);
}

void refuse_softening(const CaseTable& table) {
  if (const char* key = find_given(table, keys)) {
    table.refuse(key, "is given, but the material is unbreakable",
                 "delete it, or give a finite fracture_energy");
  }
}

}  // namespace perilink
