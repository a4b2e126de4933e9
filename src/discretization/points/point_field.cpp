#include "discretization/points/point_field.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace perilink {
namespace {

/// Part of the extent by which round-off parts equal coordinates.
constexpr double same_coordinate = 1e-9;

/// Returns the different coordinates of points along an axis, ascending.
std::vector<double> coordinates_along(std::span<const double> positions, int dim, int axis) {
  std::vector<double> line;
  for (auto k = static_cast<std::size_t>(axis); k < positions.size();
       k += static_cast<std::size_t>(dim)) {
    if (line.empty() || line.back() != positions[k]) line.push_back(positions[k]);
  }
  std::ranges::sort(line);
  const double same = same_coordinate * (line.back() - line.front());
  double last = line.front();  // of the coordinates that are equal so far
  std::size_t count = 1;
  for (const double x : line) {
    if (x - last > same) line[count++] = x;
    last = x;
  }
  line.resize(count);
  return line;
}

/// Returns the number of the line of a grid at a coordinate.
std::size_t line_below(const std::vector<double>& lines, double x) {
  const auto next = std::ranges::upper_bound(lines, x);
  return static_cast<std::size_t>(next - lines.begin()) - 1;
}

/// Sorts points by their coordinates and removes equal points.
/// \throws UnlikePoints
void sort_points(std::vector<double>& positions, std::vector<double>& values, int dim) {
  std::vector<std::pair<Vector3, Index>> points(values.size());
  for (std::size_t k = 0; k < points.size(); ++k) {
    std::copy_n(positions.begin() + static_cast<std::ptrdiff_t>(k * dim), dim,
                points[k].first.begin());
    points[k].second = static_cast<Index>(k);
  }
  std::ranges::sort(points);
  std::vector<double> sorted;
  sorted.reserve(values.size());
  positions.clear();
  for (std::size_t k = 0; k < points.size(); ++k) {
    const auto& [place, number] = points[k];
    if (k > 0 && place == points[k - 1].first) {
      if (values[number] != sorted.back()) throw UnlikePoints(points[k - 1].second, number);
      continue;
    }
    positions.insert(positions.end(), place.begin(), place.begin() + dim);
    sorted.push_back(values[number]);
  }
  values = std::move(sorted);
}

Box box_around(std::span<const double> positions, int dim) {
  Box box;
  for (int a = 0; a < dim; ++a) box.lower[a] = box.upper[a] = positions[a];
  for (std::size_t k = 0; k < positions.size(); ++k) {
    const std::size_t a = k % static_cast<std::size_t>(dim);
    box.lower[a] = std::min(box.lower[a], positions[k]);
    box.upper[a] = std::max(box.upper[a], positions[k]);
  }
  return box;
}

}  // namespace

PointField::PointField(std::vector<double> positions, std::vector<double> values, int dim)
    : dim_(dim), box_(box_around(positions, dim)), values_(std::move(values)) {
  if (lay_grid(positions)) return;
  sort_points(positions, values_, dim);  // the order of rows decides nothing
  nearest_.emplace(std::move(positions), dim);
}

/// Sorts the values to the crossings of a grid, if there is one point for each.
bool PointField::lay_grid(std::span<const double> positions) {
  const std::size_t points = values_.size();
  std::size_t crossings = 1;
  for (int a = 0; a < dim_; ++a) {
    lines_[a] = coordinates_along(positions, dim_, a);
    crossings *= lines_[a].size();
    if (crossings < 2 * points) continue;
    lines_ = {};
    return false;
  }
  if (crossings > points) return false;
  std::vector<Index> owner(crossings, no_index);
  for (std::size_t k = 0; k < points; ++k) {
    std::size_t place = 0;
    for (int a = dim_; a-- > 0;) {
      place = place * lines_[a].size() + line_below(lines_[a], positions[k * dim_ + a]);
    }
    Index& own = owner[place];
    if (own == no_index) own = static_cast<Index>(k);
    if (values_[own] != values_[k]) throw UnlikePoints(own, static_cast<Index>(k));
  }
  if (std::ranges::find(owner, no_index) != owner.end()) return false;
  std::vector<double> sorted;
  sorted.reserve(crossings);
  for (const Index own : owner) sorted.push_back(values_[own]);
  values_ = std::move(sorted);
  return true;
}

double PointField::at(std::span<const double> position) const {
  return nearest_ ? values_[nearest_->at(position)] : interpolated(position);
}

double PointField::interpolated(std::span<const double> position) const {
  std::array<std::size_t, 3> first{}, step{};  // in the values; no step along the axis: 0
  std::array<double, 3> part{};
  std::size_t stride = 1;
  for (int a = 0; a < dim_; ++a) {
    const std::vector<double>& lines = lines_[a];
    if (lines.size() > 1) {
      const double x = std::clamp(position[a], lines.front(), lines.back());
      const std::size_t k = std::min(line_below(lines, x), lines.size() - 2);
      part[a] = std::min((x - lines[k]) / (lines[k + 1] - lines[k]), 1.0);
      first[a] = k * stride;
      step[a] = stride;
    }
    stride *= lines.size();
  }
  const auto along_x = [&](std::size_t place) {
    place += first[0];
    return std::lerp(values_[place], values_[place + step[0]], part[0]);
  };
  const auto along_y = [&](std::size_t place) {
    place += first[1];
    return std::lerp(along_x(place), along_x(place + step[1]), part[1]);
  };
  return dim_ == 2 ? along_y(0)
                   : std::lerp(along_y(first[2]), along_y(first[2] + step[2]), part[2]);
}

std::array<std::size_t, 3> PointField::counts() const {
  return {lines_[0].size(), lines_[1].size(), lines_[2].size()};
}

double PointField::margin(int axis, bool upper) const {
  if (box_.lower[axis] == box_.upper[axis]) return infinity;
  const std::vector<double>& lines = lines_[axis];
  if (is_grid()) {
    return 0.5 * (upper ? lines[lines.size() - 1] - lines[lines.size() - 2] : lines[1] - lines[0]);
  }
  return (box_.upper[axis] - box_.lower[axis]) /
         std::pow(static_cast<double>(values_.size()), 1.0 / dim_);
}

}  // namespace perilink
