#include "io/case/sections/case_rebar.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <stdexcept>
#include <utility>

#include "base/plain_text.hpp"
#include "io/case/binding/key_binding.hpp"
#include "io/case/sections/case_kinds.hpp"
#include "io/case/sections/case_stages.hpp"

namespace perilink {
namespace {

/// Relative tolerance between Young's modulus and the first point of a stress-strain curve.
constexpr double same_modulus = 1e-3;

BarLayout read_layout(const CaseTable& table, int dim) {
  BarLayout layout;
  layout.region = *table.text("inside");
  layout.along = table.text("along")->front() - 'x';
  layout.cover = *table.number("cover");
  table.need_one_of({"face", "spacing"});
  layout.spacing = table.number("spacing");
  if (layout.spacing) {
    if (!table.has("number")) return layout;
    table.refuse("number", "is given together with `spacing`",
                 "stirrups have a spacing; bars beside a face have a number");
  }
  const auto face = table.text("face");
  layout.face = ((*face)[1] - 'x') + ((*face)[0] == '+' ? 3 : 0);
  if (*layout.face % 3 == layout.along || *layout.face % 3 >= dim) {
    table.refuse("face", "is not parallel to the bars",
                 "give a face with another normal than `along`");
  }
  if (const TomlValue* number = table.value("number"))
    layout.number = static_cast<int>(number->integer);
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
    if (bar.points.size() < 2 && !table.has("group")) {
      table.refuse("points", "has fewer than two points", "give the ends of the bar and its bends");
    }
    for (std::size_t k = 1; k < bar.points.size(); ++k) {
      if (bar.points[k] != bar.points[k - 1]) continue;
      table.refuse("points", fmt::format("has point {} twice", k), "give every point once");
    }
  }
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
}

void check_steel(const CaseTable& table, const RebarSection& bar) {
  if (bar.hardening_modulus >= bar.youngs_modulus) {
    table.refuse("hardening_modulus", fmt::format("is {}", bar.hardening_modulus),
                 "it lies between zero and Young's modulus");
  }
  const bool has_limit = bar.yield_strength || !bar.curve.empty();
  if (table.has("yields") && bar.yields && !has_limit) {
    table.refuse("yields", "is true, but the bar has no yield strength",
                 "give `yield_strength`, or leave `yields` out for an elastic bar");
  }
  if (!bar.curve.empty()) {
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

RebarSection read_rebar(const CaseTable& table, Kinds kind) {
  auto bar = read_section<RebarSection>("rebar", table, kind);
  read_place(table, dimension_of(kind), bar);
  check_steel(table, bar);
  if (bar.bond.model_code.failure == BondFailure::splitting) {
    bar.bond.model_code.rib_spacing = 0.0;
  } else if (bar.bond.type == RebarBond::model_code && !table.has("rib_spacing")) {
    table.refuse_missing("rib_spacing", "the clear distance between ribs");
  }
  if (bar.bends && (bar.rupture_strain || (!bar.curve.empty() && bar.curve.back()[1] == 0.0))) {
    table.refuse("bends",
                 "is true, but the steel can rupture: a ruptured bar would leave rotations without "
                 "stiffness",
                 "delete it, or the end of the steel");
  }
  if (!bar.stage.empty() && bar.prestrain == 0.0) {
    table.refuse("stage", "is given, but the bar has no `prestrain` for the stage", "delete it");
  }
  return bar;
}

void check_rebar(const CaseFile& input) {
  for (std::size_t k = 0; k < input.rebar.size(); ++k) {
    const RebarSection& bar = input.rebar[k];
    if (bar.bond.type == RebarBond::concrete) {
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

void write_bar_place(TomlWriter& out, const RebarSection& bar, Kinds kind) {
  const int dim = dimension_of(kind);
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
    out.write("points", bar.points, dim);
  }
}

}  // namespace perilink
