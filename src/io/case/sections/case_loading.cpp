// [[supports]], [[displacements]] and loads.

#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "io/case/binding/key_binding.hpp"
#include "io/case/case_words.hpp"
#include "io/case/sections/case_kinds.hpp"
#include "io/case/sections/case_sections.hpp"

namespace perilink {
namespace {

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

/// Reads a moment: a number (about z) in two dimensions, a vector in three.
Vector3 read_moment(const CaseTable& table, Kinds kind) {
  if (axes_of(kind) == 2) return {0.0, 0.0, *table.number("moment")};
  return *table.vector("moment", 3);
}

/// Refuses a load or a stiffness of zero.
void refuse_zero(const CaseTable& table, const char* key, bool zero, const char* what) {
  if (!zero) return;
  table.refuse(key, "is zero in every direction",
               std::string("give the ") + what + ", or delete the table");
}
constexpr const char* load_at_one = "load at load factor 1";

}  // namespace

LoadSection read_load(const CaseTable& table, Kinds kind) {
  const auto load = read_section<LoadSection>("loads", table, kind);
  refuse_zero(table, load.force ? "force" : "body_force",
              load.force ? *load.force == Vector3{} : load.body_force->is_zero(), load_at_one);
  return load;
}

TractionSection read_traction(const CaseTable& table, Kinds kind) {
  const auto section = read_section<TractionSection>("tractions", table, kind);
  refuse_zero(table, section.traction ? "traction" : "pressure",
              section.traction ? section.traction->is_zero() : section.pressure->is_zero(),
              load_at_one);
  return section;
}

PointLoadSection read_point_load(const CaseTable& table, Kinds kind) {
  auto section = read_section<PointLoadSection>("point_loads", table, kind);
  const bool turns = table.has("moment");
  if (turns) section.moment = read_moment(table, kind);
  if (!turns && !table.has("force")) table.refuse_missing("force", "the force at load factor 1");
  refuse_zero(table, turns ? "moment" : "force",
              section.force == Vector3{} && section.moment == Vector3{}, load_at_one);
  return section;
}

SpringSection read_springs(const CaseTable& table, Kinds kind) {
  const auto section = read_section<SpringSection>("springs", table, kind);
  const auto& given = section.stiffness ? section.stiffness : section.total;
  refuse_zero(table, section.stiffness ? "stiffness" : "total", *given == Vector3{}, "stiffness");
  return section;
}

SupportSection read_support(const CaseTable& table, const CaseFile& input) {
  auto support = read_section<SupportSection>("supports", table, kinds_of(input));
  const std::vector<std::string> names = *table.texts("fix");
  if (names.empty()) table.refuse("fix", "names no axis", "write fix = [\"x\", \"y\"]");
  for (const std::string& name : names) {
    bool& fixed = support.fix[find_held_component(table, input.body, name)];
    if (fixed) table.refuse("fix", fmt::format("names \"{}\" twice", name), "name it once");
    fixed = true;
  }
  return support;
}

DisplacementSection read_displacement(const CaseTable& table, const char* name, Kinds kind) {
  const auto prescribed = read_section<DisplacementSection>(name, table, kind);
  if (std::ranges::none_of(prescribed.value, [](const auto& value) { return value.has_value(); })) {
    table.refuse("", "moves no axis",
                 axes_of(kind) == 2 ? "give x or y or both" : "give one or more of x, y, z");
  }
  return prescribed;
}

}  // namespace perilink
