// Loads and supports: [[tractions]], [[point_loads]], [[symmetry]], [[springs]].

#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "io/case/case_words.hpp"
#include "io/case/sections/case_kinds.hpp"
#include "io/case/sections/case_sections.hpp"

namespace perilink {
namespace {

/// Reads a moment: a number (about z) in two dimensions, a vector in three.
Vector3 read_moment(const CaseTable& table, const BodySection& body) {
  if (!table.has("moment")) return {};
  if (axes_of(body) == 2) return {0.0, 0.0, *table.number("moment")};
  return *table.vector("moment", 3);
}

/// Reads a stiffness along each axis, which must not be negative.
std::optional<Vector3> read_stiffness(const CaseTable& table, const std::string& key, int dim) {
  const std::optional<Vector3> values = table.vector(key, dim);
  if (!values) return values;
  if (std::any_of(values->begin(), values->end(), [](double k) { return k < 0.0; })) {
    table.refuse(key, "holds a negative stiffness", "give stiffnesses that are zero or positive");
  }
  if (*values == Vector3{}) {
    table.refuse(key, "is zero in every direction", "give a stiffness, or delete the table");
  }
  return values;
}

}  // namespace

TractionSection read_traction(const CaseTable& table, const BodySection& body) {
  const int dim = dimension_of(body);
  TractionSection section;
  section.region = table.need_region("whose surface is loaded");
  table.need_one_of({"traction", "pressure"});
  section.traction = table.expressions("traction", axes_of(body), dim);
  section.pressure = table.expression("pressure", dim);
  assign(section.stage, table.text("stage"));
  if (section.traction ? section.traction->is_zero() : section.pressure->is_zero()) {
    table.refuse(section.traction ? "traction" : "pressure",
                 section.traction ? "is zero in every direction" : "is zero",
                 "give the load at load factor 1, or delete the table");
  }
  return section;
}

PointLoadSection read_point_load(const CaseTable& table, const BodySection& body) {
  const int dim = dimension_of(body);
  PointLoadSection section;
  section.at = table.need("at", table.vector("at", dim), "the point that is loaded");
  if (!table.has("moment")) {
    section.force =
        table.need("force", table.vector("force", axes_of(body)), "the force at load factor 1");
  }
  assign(section.force, table.vector("force", axes_of(body)));
  assign(section.stage, table.text("stage"));
  section.moment = read_moment(table, body);
  if (section.force == Vector3{} && section.moment == Vector3{}) {
    table.refuse(table.has("moment") ? "moment" : "force", "is zero in every direction",
                 "give the load at load factor 1, or delete the table");
  }
  return section;
}

SymmetrySection read_symmetry(const CaseTable& table, int dim) {
  SymmetrySection section;
  const std::string axis = table.need("axis", table.choice("axis", {"x", "y", "z"}),
                                      "the axis normal to the plane of symmetry");
  section.axis = axis[0] - 'x';
  if (section.axis >= dim) {
    table.refuse("axis", "is an axis that a two-dimensional body does not have", "Allowed: x, y");
  }
  table.need_one_of({"at", "region"});
  section.at = table.number("at");
  assign(section.region, table.text("region"));
  return section;
}

SpringSection read_springs(const CaseTable& table, int dim) {
  SpringSection section;
  section.region = table.need_region("that is held elastically");
  table.need_one_of({"stiffness", "total"});
  section.stiffness = read_stiffness(table, "stiffness", dim);
  section.total = read_stiffness(table, "total", dim);
  return section;
}

}  // namespace perilink
