#include "discretization/point_boxes.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

namespace perilink {
namespace {

void bisect(std::span<Index> points, std::span<const double> positions, int dim, Index parts,
            std::vector<std::vector<Index>>& boxes) {
  if (parts <= 1) {
    boxes.emplace_back(points.begin(), points.end());
    std::sort(boxes.back().begin(), boxes.back().end());
    return;
  }
  const auto at = [&](Index p, int axis) {
    return positions[static_cast<std::size_t>(p) * dim + axis];
  };
  int longest = 0;
  double length = -1.0;
  for (int axis = 0; axis < dim; ++axis) {
    const auto [low, high] = std::minmax_element(
        points.begin(), points.end(), [&](Index a, Index b) { return at(a, axis) < at(b, axis); });
    if (at(*high, axis) - at(*low, axis) <= length) continue;
    length = at(*high, axis) - at(*low, axis);
    longest = axis;
  }
  const Index left = parts / 2;
  const std::size_t middle = points.size() * static_cast<std::size_t>(left) / parts;
  std::nth_element(points.begin(), points.begin() + static_cast<std::ptrdiff_t>(middle),
                   points.end(), [&](Index a, Index b) {
                     return std::pair(at(a, longest), a) < std::pair(at(b, longest), b);
                   });
  bisect(points.first(middle), positions, dim, left, boxes);
  bisect(points.subspan(middle), positions, dim, parts - left, boxes);
}

}  // namespace

std::vector<std::vector<Index>> split_into_boxes(std::span<const double> positions, int dim,
                                                 Index most) {
  const Index count = static_cast<Index>(positions.size()) / dim;
  std::vector<Index> points(static_cast<std::size_t>(count));
  std::iota(points.begin(), points.end(), 0);
  std::vector<std::vector<Index>> boxes;
  bisect(points, positions, dim, (count + most - 1) / most, boxes);
  return boxes;
}

std::vector<std::vector<Index>> split_unjoined(const std::vector<std::vector<Index>>& boxes,
                                               JoinedParts& parts) {
  std::vector<std::vector<Index>> split;
  for (std::vector<Index> box : boxes) {
    std::ranges::stable_sort(box, {}, [&](Index p) { return parts.find(p); });
    for (std::size_t k = 0; k < box.size(); ++k) {
      if (k == 0 || parts.find(box[k]) != parts.find(box[k - 1])) split.emplace_back();
      split.back().push_back(box[k]);
    }
  }
  return split;
}

}  // namespace perilink
