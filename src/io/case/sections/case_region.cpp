// [[regions]]: boxes, discs, balls, cylinders and physical groups.

#include <fmt/format.h>

#include <string>
#include <vector>

#include "base/plain_text.hpp"
#include "io/case/case_words.hpp"
#include "io/case/sections/case_sections.hpp"

namespace perilink {
namespace {

Region read_group(const CaseTable& table, Region region, int dim) {
  region.group = *table.text("group");
  if (region.group.empty()) table.refuse("group", "is empty", "name a physical group of the mesh");
  for (const char* key : {"center", "radius"}) {
    if (!table.has(key)) continue;
    table.refuse(key, "is given together with `group`",
                 "a region is either a physical group or a shape; delete one of the two");
  }
  for (int axis = 0; axis < dim; ++axis) {
    if (!table.has(axis_names[axis])) continue;
    table.refuse(axis_names[axis], "is given together with `group`",
                 "a region is a physical group or a box; delete one of the two");
  }
  return region;
}

void read_interval(const CaseTable& table, int axis, Box& box) {
  const std::string key = axis_names[axis];
  const std::vector<double> interval =
      table.need(key, table.numbers(key), "the interval [lower, upper]");
  if (interval.size() != 2) {
    table.refuse(key,
                 fmt::format("has {}, but an interval has 2", counted(interval.size(), "value")),
                 "write [lower, upper]");
  }
  // Equal ends make a line or a point, which supports may use; check_shape() refuses them for
  // materials.
  if (interval[0] > interval[1]) {
    table.refuse(key,
                 fmt::format("is [{}, {}], but the lower end must be less than the upper",
                             interval[0], interval[1]),
                 "exchange the two ends");
  }
  box.lower[axis] = interval[0];
  box.upper[axis] = interval[1];
}

/// Returns the axis of a cylinder, the one with an interval; std::nullopt for discs and balls.
std::optional<int> axis_of_cylinder(const CaseTable& table, int dim) {
  std::optional<int> axis;
  for (int a = 0; a < dim; ++a) {
    if (!table.has(axis_names[a])) continue;
    if (dim == 2) {
      table.refuse(axis_names[a], "is given together with `radius`",
                   "a region is a disc or a box; delete one of the two");
    }
    if (axis) {
      table.refuse(axis_names[a], "is a second interval beside `radius`",
                   "a cylinder has one interval, along its axis; a ball has none");
    }
    axis = a;
  }
  return axis;
}

Region read_round(const CaseTable& table, Region region, int dim) {
  Round round;
  round.axis = axis_of_cylinder(table, dim);
  round.radius = table.need("radius", table.number("radius", allowed::positive), "the radius");
  const std::vector<double> center =
      table.need("center", table.numbers("center"), "the center of the radius");
  const std::size_t size = static_cast<std::size_t>(round.axis ? 2 : dim);
  if (center.size() != size) {
    const char* what = dim == 2 ? "a disc" : round.axis ? "a cylinder" : "a ball";
    table.refuse("center",
                 fmt::format("has {}, but the center of {} has {}", counted(center.size(), "value"),
                             what, size),
                 round.axis ? "give the coordinates across its axis" : "give one per axis");
  }
  std::size_t next = 0;
  for (int axis = 0; axis < dim; ++axis) {
    if (round.axis == axis) {
      read_interval(table, axis, region.box);
      continue;
    }
    round.center[axis] = center[next++];
    region.box.lower[axis] = round.center[axis] - round.radius;
    region.box.upper[axis] = round.center[axis] + round.radius;
  }
  region.round = round;
  return region;
}

}  // namespace

Region read_region(const CaseTable& table, int dim) {
  Region region;
  region.name = table.need("name", table.text("name"), "a name for other tables to refer to");
  if (region.name.empty()) table.refuse("name", "is empty", "give the region a name");
  if (table.has("group")) return read_group(table, region, dim);
  if (table.has("radius") || table.has("center")) return read_round(table, region, dim);
  for (int axis = 0; axis < dim; ++axis) read_interval(table, axis, region.box);
  return region;
}

void write_region(TomlWriter& out, const Region& region, int dim) {
  out.header("[[regions]]");
  out.write("name", region.name);
  if (!region.group.empty()) return out.write("group", region.group);
  std::vector<double> center;
  for (int axis = 0; axis < dim; ++axis) {
    if (region.round && region.round->axis != axis) {
      center.push_back(region.round->center[axis]);
      continue;
    }
    out.write(axis_names[axis],
              std::vector<double>{region.box.lower[axis], region.box.upper[axis]});
  }
  if (!region.round) return;
  out.write("center", center);
  out.write("radius", region.round->radius);
}

}  // namespace perilink
