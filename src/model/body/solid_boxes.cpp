#include "model/body/solid_boxes.hpp"

#include <algorithm>

#include "base/error.hpp"
#include "io/case/sections/case_kinds.hpp"

namespace perilink {
namespace {

/// Splits a box around a hole into boxes that share faces with it.
void cut_hole(const Box& box, const Box& hole, int dim, std::vector<Box>& remaining) {
  for (int a = 0; a < dim; ++a) {
    if (hole.lower[a] >= box.upper[a] || hole.upper[a] <= box.lower[a]) {
      remaining.push_back(box);
      return;
    }
  }
  Box core = box;
  for (int a = 0; a < dim; ++a) {
    if (hole.lower[a] > core.lower[a]) {
      remaining.push_back(core);
      remaining.back().upper[a] = core.lower[a] = hole.lower[a];
    }
    if (hole.upper[a] < core.upper[a]) {
      remaining.push_back(core);
      remaining.back().lower[a] = core.upper[a] = hole.upper[a];
    }
  }
}

}  // namespace

const Region& region_named(const CaseFile& input, const std::string& name) {
  return *std::find_if(input.regions.begin(), input.regions.end(),
                       [&](const Region& region) { return region.name == name; });
}

std::vector<Box> boxes_of(const CaseFile& input, std::size_t material) {
  std::vector<Box> boxes;
  for (const std::string& name : input.materials[material].regions) {
    boxes.push_back(region_named(input, name).box);
  }
  for (const std::string& name : input.materials[material].holes) {
    std::vector<Box> remaining;
    for (const Box& box : boxes) {
      cut_hole(box, region_named(input, name).box, dimension_of(input.body), remaining);
    }
    boxes = std::move(remaining);
  }
  if (!boxes.empty()) return boxes;
  throw InputError(input.where(item_key("materials", material, "holes")),
                   "remove all of the material", "make the holes smaller");
}

Box bounding_box(const std::vector<Box>& boxes) {
  Box all = boxes.front();
  for (const Box& box : boxes) {
    for (int a = 0; a < 3; ++a) {
      all.lower[a] = std::min(all.lower[a], box.lower[a]);
      all.upper[a] = std::max(all.upper[a], box.upper[a]);
    }
  }
  return all;
}

}  // namespace perilink
