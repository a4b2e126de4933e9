#include "io/case/sections/case_rebar.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <stdexcept>
#include <utility>

#include "base/plain_text.hpp"
#include "io/case/case_schema.hpp"
#include "io/case/sections/case_kinds.hpp"
#include "io/case/sections/case_stages.hpp"

namespace perilink {
namespace {

constexpr int most_bars = 100000;

/// Relative tolerance between Young's modulus and the first point of a stress-strain curve.
constexpr double same_modulus = 1e-3;

std::vector<std::vector<double>> rows(const std::vector<Vector3>& vectors, int dim) {
  std::vector<std::vector<double>> list;
  for (const Vector3& vector : vectors) list.emplace_back(vector.begin(), vector.begin() + dim);
  return list;
}

/// Reads a list of pairs of numbers.
std::vector<std::array<double, 2>> read_curve(const CaseTable& table, const std::string& key) {
  std::vector<std::array<double, 2>> curve;
  for (const Vector3& point : table.vectors(key, 2).value_or(std::vector<Vector3>())) {
    curve.push_back({point[0], point[1]});
  }
  if (!table.has(key)) return curve;
  try {
    check_curve({curve});
  } catch (const std::invalid_argument& error) {
    table.refuse(key, fmt::format("is not a valid curve: {}", error.what()),
                 "write points from the end of the first straight line on: [[0.1, 4], [1, 10]]");
  }
  return curve;
}

void write_curve(TomlWriter& out, const char* key,
                 const std::vector<std::array<double, 2>>& curve) {
  std::vector<std::vector<double>> list;
  for (const auto& [x, y] : curve) list.push_back({x, y});
  if (!list.empty()) out.write(key, list);
}

BarLayout read_layout(const CaseTable& table, int dim) {
  BarLayout layout;
  layout.region = table.need("inside", table.text("inside"), "the region that bars are laid in");
  const auto axis = table.need("along", table.choice("along", {"x", "y", "z"}),
                               "the axis that the bars, or the beam in its stirrups, go along");
  layout.along = axis[0] - 'x';
  if (layout.along >= dim) {
    table.refuse("along", "is an axis that a two-dimensional body does not have", "Allowed: x, y");
  }
  layout.cover = table.need("cover", table.positive("cover"),
                            "the distance between the faces of the region and the bars");
  table.need_one_of({"face", "spacing"});
  layout.spacing = table.positive("spacing");
  if (layout.spacing) {
    if (!table.has("number")) return layout;
    table.refuse("number", "is given together with `spacing`",
                 "stirrups have a spacing; bars beside a face have a number");
  }
  const auto face = table.choice("face", {"-x", "-y", "-z", "+x", "+y", "+z"});
  layout.face = ((*face)[1] - 'x') + ((*face)[0] == '+' ? 3 : 0);
  if (*layout.face % 3 == layout.along || *layout.face % 3 >= dim) {
    table.refuse("face", "is not parallel to the bars",
                 "give a face with another normal than `along`");
  }
  assign(layout.number, table.integer("number", 1, most_bars));
  if (dim == 2 && layout.number > 1) {
    table.refuse("number", "is above one, but a layer in the plane is one bar",
                 "give the area of all bars, or lay `copies`");
  }
  return layout;
}

void read_place(const CaseTable& table, int dim, RebarSection& bar) {
  table.need_one_of({table.has("to") ? "to" : "from", "points", "inside", "group"});
  if (table.has("from") || table.has("to")) {
    const Vector3 from =
        table.need("from", table.vector("from", dim), "the point where the bar begins");
    const Vector3 to = table.need("to", table.vector("to", dim), "the point where the bar ends");
    bar.points = {from, to};
    if (from == to) {
      table.refuse("to", "is the same point as `from`, so the bar has no length",
                   "give the two ends of the bar");
    }
  } else {
    assign(bar.points, table.vectors("points", dim));
    assign(bar.group, table.text("group"));
    if (table.has("group") && bar.group.empty()) {
      table.refuse("group", "is empty", "name a physical group of curves of the mesh");
    }
  }
  if (table.has("inside")) {
    bar.layout = read_layout(table, dim);
  } else {
    for (const char* key : {"along", "cover", "face", "number", "spacing"}) {
      if (table.has(key)) table.refuse(key, "is given without `inside`", "delete it");
    }
    if (bar.points.size() < 2 && !table.has("group")) {
      table.refuse("points", "has fewer than two points", "give the ends of the bar and its bends");
    }
    for (std::size_t k = 1; k < bar.points.size(); ++k) {
      if (bar.points[k] != bar.points[k - 1]) continue;
      table.refuse("points", fmt::format("has point {} twice", k), "give every point once");
    }
  }
  assign(bar.copies, table.integers("copies", 1, most_bars));
  assign(bar.steps, table.vectors("steps", dim));
  if (bar.copies.size() != bar.steps.size()) {
    table.refuse(table.has("steps") ? "steps" : "copies",
                 fmt::format("`copies` has {} and `steps` has {}, but they must be equal",
                             counted(bar.copies.size(), "entry", "entries"), bar.steps.size()),
                 "give a number and a step for each direction: copies = [3], steps = [[0, 50]]");
  }
  for (std::size_t k = 0; k < bar.steps.size(); ++k) {
    if (bar.steps[k] != Vector3{}) continue;
    table.refuse("steps",
                 fmt::format("has a step {} of zero, which puts bars at the same place", k + 1),
                 "give the vector from one bar to the next");
  }
  assign(bar.across_gaps, table.boolean("across_gaps"));
}

void read_steel(const CaseTable& table, RebarSection& bar) {
  bar.youngs_modulus =
      table.need("youngs_modulus", table.positive("youngs_modulus"), "Young's modulus of the bar");
  bar.area = table.need("area", table.positive("area"), "the area of the bar's cross-section");
  bar.yield_strength = table.positive("yield_strength");
  assign(bar.yields, table.boolean("yields"));
  bar.curve = read_curve(table, "stress_strain");
  bar.rupture_strain = table.positive("rupture_strain");
  if (const auto slope = table.number("hardening_modulus")) {
    bar.hardening_modulus = *slope;
    if (!(*slope >= 0.0 && *slope < bar.youngs_modulus)) {
      table.refuse("hardening_modulus", fmt::format("is {}", *slope),
                   "it lies between zero and Young's modulus");
    }
  }
  const bool has_limit = bar.yield_strength || !bar.curve.empty();
  if (table.has("yields") && bar.yields && !has_limit) {
    table.refuse("yields", "is true, but the bar has no yield strength",
                 "give `yield_strength`, or leave `yields` out for an elastic bar");
  }
  if (!bar.curve.empty()) {
    for (const char* key : {"yield_strength", "hardening_modulus"}) {
      if (table.has(key))
        table.refuse(key, "is given together with `stress_strain`", "delete one of them");
    }
    const double modulus = bar.curve.front()[1] / bar.curve.front()[0];
    if (std::abs(modulus - bar.youngs_modulus) > same_modulus * bar.youngs_modulus) {
      table.refuse("stress_strain",
                   fmt::format("begins with a modulus of {:.6g}, but youngs_modulus is {}", modulus,
                               bar.youngs_modulus),
                   "begin the curve where the steel ceases to be elastic");
    }
  }
  const double yield = !bar.curve.empty()   ? bar.curve.back()[0]
                       : bar.yield_strength ? *bar.yield_strength / bar.youngs_modulus
                                            : 0.0;
  for (const char* key : {"hardening_modulus", "rupture_strain"}) {
    if (table.has(key) && !has_limit) {
      table.refuse(key, "is given, but the bar does not yield", "give `yield_strength`");
    }
  }
  if (bar.rupture_strain && *bar.rupture_strain <= yield) {
    table.refuse("rupture_strain", fmt::format("is {}", *bar.rupture_strain),
                 fmt::format("give more than {:.6g}, up to where the steel is known", yield));
  }
}

/// Refuses keys of other kinds of bond.
void refuse_keys_of_others(const CaseTable& table, RebarBond bond) {
  const std::vector<std::pair<const char*, RebarBond>> owners = {
      {"bond_stiffness", RebarBond::linear},
      {"bond_strength", RebarBond::linear},
      {"concrete_strength", RebarBond::model_code},
      {"rib_spacing", RebarBond::model_code},
      {"bond_failure", RebarBond::model_code},
      {"bond_conditions", RebarBond::model_code},
      {"megapascal", RebarBond::model_code},
      {"millimetre", RebarBond::model_code},
      {"bond_curve", RebarBond::curve},
      {"ties_break", RebarBond::concrete}};
  for (const auto& [key, owner] : owners) {
    if (bond == owner || !table.has(key)) continue;
    table.refuse(key, fmt::format("is given, but the bond is \"{}\"", word_of(bond)),
                 fmt::format("delete it, or set bond = \"{}\"", word_of(owner)));
  }
  if (bond != RebarBond::concrete) return;
  for (const char* key : {"perimeter", "hooks", "bends", "prestrain", "across_gaps"}) {
    if (!table.has(key)) continue;
    table.refuse(key, "is given, but the bond is \"concrete\"",
                 "delete it, or choose another bond: \"perfect\" does not slip");
  }
}

void read_bond(const CaseTable& table, RebarSection& bar) {
  assign(bar.bond, table.choice<RebarBond>("bond"));
  refuse_keys_of_others(table, bar.bond);
  assign(bar.slip_springs_break, table.boolean("ties_break"));
  bar.perimeter = table.positive("perimeter");
  assign(bar.hooks, table.choice<Hooks>("hooks"));
  assign(bar.bends, table.boolean("bends"));
  if (bar.bond == RebarBond::linear) {
    bar.bond_stiffness = table.need("bond_stiffness", table.positive("bond_stiffness"),
                                    "the bond stress over the slip");
    bar.bond_strength = table.positive("bond_strength");
  }
  if (bar.bond == RebarBond::curve) {
    if (!table.has("bond_curve")) {
      table.refuse_missing("bond_curve", "slips and bond stresses: [[0.1, 4], [1, 10]]");
    }
    bar.bond_curve = read_curve(table, "bond_curve");
  }
  if (bar.bond != RebarBond::model_code) return;
  ModelCodeBond& code = bar.model_code;
  code.mean_strength = table.need("concrete_strength", table.positive("concrete_strength"),
                                  "the mean compressive strength of the concrete");
  assign(code.failure, table.choice<BondFailure>("bond_failure"));
  assign(code.conditions, table.choice<BondConditions>("bond_conditions"));
  assign(code.megapascal, table.positive("megapascal"));
  assign(code.millimetre, table.positive("millimetre"));
  const auto ribs = table.positive("rib_spacing");
  if (code.failure != BondFailure::splitting) {
    code.rib_spacing = table.need("rib_spacing", ribs, "the clear distance between ribs");
  }
}

/// Plastic strains of earlier stages move an end of each bar element with its node, which needs the
/// direct solver.
void refuse_flow_without_factor(const CaseFile& input, std::size_t k) {
  const RebarSection& bar = input.rebar[k];
  const bool flows = bar.yields && (bar.yield_strength || !bar.curve.empty());
  if (input.analysis.solver != LinearSolver::iterative || input.stages.empty() || !flows) return;
  throw InputError(input.where("analysis.solver"),
                   fmt::format("is \"iterative\", but rebar[{}] may yield in a case with "
                               "[[stages]], which needs the direct solver",
                               k + 1),
                   "set solver = \"direct\", or yields = false in [[rebar]]");
}

}  // namespace

RebarSection read_rebar(const CaseTable& table, int dim) {
  RebarSection bar;
  read_place(table, dim, bar);
  read_steel(table, bar);
  read_bond(table, bar);
  if (bar.bends && (bar.rupture_strain || (!bar.curve.empty() && bar.curve.back()[1] == 0.0))) {
    table.refuse("bends",
                 "is true, but the steel can rupture: a ruptured bar would leave rotations without "
                 "stiffness",
                 "delete it, or the end of the steel");
  }
  assign(bar.prestrain, table.number("prestrain"));
  assign(bar.stage, table.text("stage"));
  if (!bar.stage.empty() && bar.prestrain == 0.0) {
    table.refuse("stage", "is given, but the bar has no `prestrain` for the stage", "delete it");
  }
  return bar;
}

void check_rebar(const CaseFile& input) {
  for (std::size_t k = 0; k < input.rebar.size(); ++k) {
    const RebarSection& bar = input.rebar[k];
    if (!bar.group.empty() && !input.body.mesh) {
      throw InputError(
          input.where(item_key("rebar", k, "group")),
          fmt::format("is \"{}\", but the body has no mesh with physical groups", bar.group),
          "give the `points` of the bar, or `mesh` in [body]");
    }
    if (bar.bond == RebarBond::concrete) {
      refuse_flow_without_factor(input, k);
      continue;
    }
    if (input.analysis.solver == LinearSolver::iterative) {
      throw InputError(input.where("analysis.solver"),
                       "is \"iterative\", but the nodes of bars are embedded between particles, "
                       "which needs the direct solver",
                       "set solver = \"direct\", or bond = \"concrete\" in [[rebar]]");
    }
    if (input.analysis.strain == Strain::green) {
      throw InputError(input.where("analysis.strain"),
                       "is \"green\", but embedded bars are for small strains only",
                       "delete the line, or set bond = \"concrete\" in [[rebar]]");
    }
    if (bar.prestrain != 0.0 && !is_quasistatic(input.analysis.type)) {
      throw InputError(input.where(item_key("rebar", k, "prestrain")),
                       "is given, but explicit runs and relaxation cannot apply a prestrain",
                       "set type = \"damage\" or \"elastic\" in [analysis]");
    }
  }
}

void write_rebar(TomlWriter& out, const RebarSection& bar, int dim) {
  out.header("[[rebar]]");
  if (bar.layout) {
    const BarLayout& layout = *bar.layout;
    out.write("inside", layout.region);
    out.write("along", axis_names[layout.along]);
    out.write("cover", layout.cover);
    out.write("spacing", layout.spacing);
    if (layout.face) {
      out.write("face",
                fmt::format("{}{}", *layout.face < 3 ? "-" : "+", axis_names[*layout.face % 3]));
      out.write("number", layout.number);
    }
  } else if (!bar.group.empty()) {
    out.write("group", bar.group);
  } else if (bar.points.size() == 2) {
    out.write("from", bar.points[0], dim);
    out.write("to", bar.points[1], dim);
  } else {
    out.write("points", rows(bar.points, dim));
  }
  if (!bar.copies.empty()) {
    out.write("copies", bar.copies);
    out.write("steps", rows(bar.steps, dim));
  }
  if (bar.across_gaps) out.write("across_gaps", true);
  out.write("youngs_modulus", bar.youngs_modulus);
  out.write("area", bar.area);
  out.write("yield_strength", bar.yield_strength);
  write_curve(out, "stress_strain", bar.curve);
  // `yields = true` without a yield strength is refused when read, so it is not written.
  if (bar.yield_strength || !bar.curve.empty() || !bar.yields) out.write("yields", bar.yields);
  if (bar.hardening_modulus != 0.0) out.write("hardening_modulus", bar.hardening_modulus);
  out.write("rupture_strain", bar.rupture_strain);
  out.write("bond", word_of(bar.bond));
  if (bar.bond == RebarBond::concrete) return out.write("ties_break", bar.slip_springs_break);
  out.write("bond_stiffness", bar.bond_stiffness);
  out.write("bond_strength", bar.bond_strength);
  write_curve(out, "bond_curve", bar.bond_curve);
  if (bar.bond == RebarBond::model_code) {
    const ModelCodeBond& code = bar.model_code;
    out.write("concrete_strength", code.mean_strength);
    if (code.rib_spacing > 0.0) out.write("rib_spacing", code.rib_spacing);
    out.write("bond_failure", word_of(code.failure));
    out.write("bond_conditions", word_of(code.conditions));
    out.write("megapascal", code.megapascal);
    out.write("millimetre", code.millimetre);
  }
  out.write("perimeter", bar.perimeter);
  out.write("hooks", word_of(bar.hooks));
  out.write("bends", bar.bends);
  if (bar.prestrain == 0.0) return;
  out.write("prestrain", bar.prestrain);
  write_stage_of(out, bar.stage);
}

}  // namespace perilink
