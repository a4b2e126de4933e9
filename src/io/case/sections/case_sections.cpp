#include "io/case/sections/case_sections.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <string>

#include "io/case/case_schema.hpp"
#include "io/case/case_words.hpp"
#include "io/case/sections/case_bond_dynamics.hpp"
#include "io/case/sections/case_kinds.hpp"
#include "io/case/sections/case_lattice.hpp"

namespace perilink {
namespace {

constexpr int largest_count = std::numeric_limits<int>::max();

/// Returns the index in SupportSection::fix of a name.
std::size_t find_held_component(const CaseTable& table, const BodySection& body,
                                const std::string& name) {
  const int dim = axes_of(body);
  const bool rotates = body.model == BodyModel::micropolar;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (name == axis_names[axis]) {
      if (axis == 2 && dim == 2) {
        table.refuse(
            "fix",
            fmt::format("names {}, which is an axis that a two-dimensional body does not have",
                        quoted(name)),
            "delete it, or set problem = \"three_dimensional\" in [body]");
      }
      return axis;
    }
    const bool turns = dim == 3 || axis == 2;
    if (!turns || name != rotation_name(dim, axis)) continue;
    if (!rotates) {
      table.refuse("fix", fmt::format("names {}, but {}", quoted(name), why_nothing_rotates(body)),
                   "delete it, or " + what_rotates(body));
    }
    return 3 + axis;
  }
  table.refuse("fix", fmt::format("names {}, which is no axis", quoted(name)),
               dim == 2 ? (rotates ? "Allowed: x, y, rotation" : "Allowed: x, y")
                        : (rotates ? "Allowed: x, y, z, rx, ry, rz" : "Allowed: x, y, z"));
}

/// Reads the keys of [analysis] of quasistatic analyses.
void read_events(const CaseTable& table, AnalysisSection& analysis) {
  assign(analysis.control, table.choice<LoadControl>("control"));
  assign(analysis.factor, table.choice<FactorRoute>("factor"));
  assign(analysis.solver, table.choice<LinearSolver>("solver"));
  analysis.coarse_box = table.integer("coarse_box", 2, 64);
  if (const auto tolerance = table.number("event_tolerance")) {
    constexpr double most = 0.2;
    if (!(*tolerance >= 0.0 && *tolerance <= most)) {
      table.refuse("event_tolerance", fmt::format("is {}, not from 0 to {}", *tolerance, most),
                   "give 0.02, or 0 for one event after the other");
    }
    analysis.event_tolerance = *tolerance;
  }
}

}  // namespace

SupportSection read_support(const CaseTable& table, const BodySection& body) {
  SupportSection support;
  support.region = table.need_region("that is held");
  const std::vector<std::string> names =
      table.need("fix", table.texts("fix"), "the axes that are held, fix = [\"x\", \"y\"]");
  if (names.empty()) table.refuse("fix", "names no axis", "write fix = [\"x\", \"y\"]");
  for (const std::string& name : names) {
    bool& fixed = support.fix[find_held_component(table, body, name)];
    if (fixed) table.refuse("fix", fmt::format("names \"{}\" twice", name), "name it once");
    fixed = true;
  }
  return support;
}

DisplacementSection read_displacement(const CaseTable& table, const BodySection& body) {
  const int dim = axes_of(body);
  DisplacementSection driven;
  driven.region = table.need_region("whose motion is prescribed");
  assign(driven.stage, table.text("stage"));
  bool any = false;
  for (std::size_t component = 0; component < 6; ++component) {
    if (dim == 2 && component >= 2 && component != 5) continue;
    driven.value[component] = table.expression(motion_name(dim, component), dimension_of(body));
    any = any || driven.value[component].has_value();
  }
  if (!any) {
    table.refuse("", "moves no axis",
                 dim == 2 ? "give x or y or both" : "give one or more of x, y, z");
  }
  return driven;
}

LoadSection read_load(const CaseTable& table, const BodySection& body) {
  LoadSection load;
  load.region = table.need_region("that is loaded");
  table.need_one_of({"force", "body_force"});
  load.force = table.vector("force", axes_of(body));
  load.body_force = table.expressions("body_force", axes_of(body), dimension_of(body));
  assign(load.stage, table.text("stage"));
  if (load.force ? *load.force == Vector3{} : load.body_force->is_zero()) {
    table.refuse(load.force ? "force" : "body_force", "is zero in every direction",
                 "give the load at load factor 1, or delete the table");
  }
  return load;
}

CrackSection read_crack(const CaseTable& table, int dim) {
  const std::string key = dim == 2 ? "points" : "corners";
  CrackSection crack;
  crack.points = table.need(key, table.vectors(key, dim),
                            dim == 2 ? "the points of a line: [[0, 1], [2, 1]]"
                                     : "the corners of a plane convex polygon");
  if (crack.points.size() < static_cast<std::size_t>(dim)) {
    table.refuse(
        key, fmt::format("has {}", crack.points.size()),
        dim == 2 ? "a crack needs two points or more" : "a crack needs three corners or more");
  }
  crack.closing = table.boolean("closing");
  return crack;
}

std::vector<double> read_load_factors(const CaseTable& table) {
  const std::vector<double> factors = table.need("load_factors", table.numbers("load_factors"),
                                                 "the load factors of the steps: [0.1, 0.2, 0.3]");
  if (factors.empty()) table.refuse("load_factors", "is empty", "give one number for each step");
  if (std::any_of(factors.begin(), factors.end(), [](double factor) { return factor < 0.0; })) {
    table.refuse("load_factors", "holds a negative load factor",
                 "reverse the signs of the loads and displacements: the load must grow");
  }
  if (std::all_of(factors.begin(), factors.end(), [](double factor) { return factor == 0.0; })) {
    table.refuse("load_factors", "holds only zeros, so no step loads the body",
                 "give one number for each step: [0.1, 0.2, 0.3]");
  }
  return factors;
}

AnalysisSection read_analysis(const CaseTable& table, AnalysisType type) {
  AnalysisSection analysis;
  analysis.type = type;
  assign(analysis.rigid_body_modes, table.choice<RigidBodyModes>("rigid_body_modes"));
  const bool is_explicit = type == AnalysisType::explicit_;
  const bool relaxes = type == AnalysisType::relaxation;
  // Keys of other types are checked but not used.
  AnalysisSection other;
  if (type == AnalysisType::elastic) analysis.tolerance = read_tolerance(table, 1e-10);
  read_strain(table, is_explicit || relaxes ? analysis : other);
  read_explicit_analysis(table, is_explicit ? analysis : other);
  read_relaxation(table, relaxes ? analysis : other);
  read_events(table, is_explicit || relaxes ? other : analysis);
  if (type == AnalysisType::elastic) {
    analysis.control = other.control;
    analysis.factor = other.factor;
  }
  if (relaxes) analysis.load_factors = {1.0};
  if (!table.has("load_factors") && analysis.control != LoadControl::steps) return analysis;
  const std::vector<double> factors = read_load_factors(table);
  if (is_explicit || type == AnalysisType::elastic) return analysis;
  if (!relaxes && analysis.control == LoadControl::events) {
    table.refuse("load_factors", "is given, but control = \"events\" finds the load factors itself",
                 "set control = \"steps\", or delete `load_factors`");
  }
  analysis.load_factors = factors;
  return analysis;
}

StopSection read_stop(const CaseTable& table) {
  StopSection stop;
  stop.broken_bonds = table.integer("broken_bonds", 1, largest_count);
  stop.load_fraction = table.positive("load_fraction");
  if (stop.load_fraction && *stop.load_fraction >= 1.0) {
    table.refuse("load_fraction",
                 fmt::format("is {}, but must be less than 1", *stop.load_fraction),
                 "0.1 stops the run when the load has fallen to a tenth of its peak");
  }
  stop.displacement = table.positive("displacement");
  return stop;
}

OutputSection read_output(const CaseTable& table, AnalysisType type) {
  OutputSection output;
  assign(output.fields_at, table.integers("fields_at", 1, largest_count));
  for (std::size_t i = 1; i < output.fields_at.size(); ++i) {
    if (output.fields_at[i] > output.fields_at[i - 1]) continue;
    table.refuse("fields_at",
                 fmt::format("has {} after {}, but the numbers must ascend", output.fields_at[i],
                             output.fields_at[i - 1]),
                 "sort the numbers of broken bonds and delete repeated ones");
  }
  output.fields_every = table.integer("fields_every", 1, largest_count);
  output.fields_every_rows = table.integer("fields_every_rows", 1, largest_count);
  output.checkpoint_every = table.integer("checkpoint_every", 0, largest_count);
  assign(output.fields_times, table.numbers("fields_times"));
  for (std::size_t i = 0; i < output.fields_times.size(); ++i) {
    const double before = i > 0 ? output.fields_times[i - 1] : 0.0;
    if (output.fields_times[i] > before) continue;
    table.refuse(
        "fields_times",
        fmt::format("has {} after {}, but times must ascend", output.fields_times[i], before),
        "sort the positive times and delete repeated ones; fields at time 0 are always written");
  }
  // Keys of other types are checked but not used.
  if (type != AnalysisType::damage) {
    output.fields_at.clear();
    output.fields_every.reset();
    output.fields_every_rows.reset();
  }
  if (type != AnalysisType::explicit_) output.fields_times.clear();
  if (type == AnalysisType::elastic) output.checkpoint_every.reset();
  return output;
}

}  // namespace perilink
