#include "discretization/meshes/cell_search.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include "discretization/meshes/cell_corners.hpp"

namespace perilink {
namespace {

constexpr double most_steps = 2000;  ///< largest number of grid cells along an axis

CellCorners corners_of(const Mesh& mesh, Index cell) {
  const std::size_t width = static_cast<std::size_t>(mesh.dim) + 1;
  return {mesh.positions, mesh.dim, std::span(mesh.cells).subspan(cell * width, width)};
}

}  // namespace

CellSearch::CellSearch(const Mesh& mesh, std::span<const Index> cells, double tolerance)
    : dim_(mesh.dim), tolerance_(tolerance) {
  if (cells.empty()) throw std::invalid_argument("there is no cell to search");
  std::vector<Box> boxes;
  for (const Index cell : cells) {
    add_sides(mesh, cell);
    Box box = corners_of(mesh, cell).box;
    for (int a = 0; a < dim_; ++a) {
      box.lower[a] -= tolerance;
      box.upper[a] += tolerance;
    }
    boxes.push_back(box);
  }
  lay_grid(boxes);
}

void CellSearch::add_sides(const Mesh& mesh, Index cell) {
  const CellCorners corners = corners_of(mesh, cell);
  for (int k = 0; k < corners.count; ++k) {
    Vector3 normal = corners.normal_of_side(k);
    const double length = norm(normal);
    double height = 0.0;
    if (length > 0.0) {
      for (double& entry : normal) entry /= length;
      height = dot(normal, minus(corners.at[k], corners.at[(k + 1) % corners.count]));
    }
    if (!(std::abs(height) > CellCorners::flattest * corners.size)) corners.refuse_flat();
    const double sign = height > 0.0 ? 1.0 : -1.0;
    for (int a = 0; a < dim_; ++a) sides_.push_back(sign * normal[a]);
    sides_.push_back(-sign * dot(normal, corners.at[(k + 1) % corners.count]));
    heights_.push_back(std::abs(height));
  }
}

void CellSearch::lay_grid(const std::vector<Box>& boxes) {
  box_ = boxes.front();
  for (const Box& box : boxes) {
    for (int a = 0; a < dim_; ++a) {
      box_.lower[a] = std::min(box_.lower[a], box.lower[a]);
      box_.upper[a] = std::max(box_.upper[a], box.upper[a]);
    }
  }
  double volume = 1.0;
  for (int a = 0; a < dim_; ++a) volume *= box_.upper[a] - box_.lower[a];
  const double size = std::pow(volume / static_cast<double>(boxes.size()), 1.0 / dim_);
  for (int a = 0; a < dim_; ++a) {
    const double steps = (box_.upper[a] - box_.lower[a]) / size;
    counts_[a] = static_cast<int>(std::clamp(std::ceil(steps), 1.0, most_steps));
  }
  const auto visit = [&](const Box& box, const auto& act) {
    std::array<int, 3> low{}, high{};
    for (int a = 0; a < dim_; ++a) {
      low[a] = step(a, box.lower[a]);
      high[a] = step(a, box.upper[a]);
    }
    for (int k = low[2]; k <= high[2]; ++k) {
      for (int j = low[1]; j <= high[1]; ++j) {
        for (int i = low[0]; i <= high[0]; ++i) act(bucket({i, j, k}));
      }
    }
  };
  const auto size_of_grid = static_cast<std::size_t>(counts_[0]) * counts_[1] * counts_[2];
  buckets_.offsets.assign(size_of_grid + 1, 0);
  for (const Box& box : boxes) visit(box, [&](Index b) { ++buckets_.offsets[b + 1]; });
  for (std::size_t b = 0; b < size_of_grid; ++b) buckets_.offsets[b + 1] += buckets_.offsets[b];
  buckets_.values.resize(static_cast<std::size_t>(buckets_.offsets.back()));
  std::vector<Index> next(buckets_.offsets.begin(), buckets_.offsets.end() - 1);
  for (std::size_t cell = 0; cell < boxes.size(); ++cell) {
    visit(boxes[cell], [&](Index b) { buckets_.values[next[b]++] = static_cast<Index>(cell); });
  }
}

int CellSearch::step(int axis, double coordinate) const {
  const double part =
      (coordinate - box_.lower[axis]) / (box_.upper[axis] - box_.lower[axis]) * counts_[axis];
  return static_cast<int>(std::clamp(std::floor(part), 0.0, counts_[axis] - 1.0));
}

Index CellSearch::bucket(const std::array<int, 3>& steps) const {
  return static_cast<Index>((steps[2] * counts_[1] + steps[1]) * counts_[0] + steps[0]);
}

/// Returns cells that touch the bucket around a point in the box.
std::span<const Index> CellSearch::near(std::span<const double> point) const {
  std::array<int, 3> steps{};
  for (int a = 0; a < dim_; ++a) steps[a] = step(a, point[a]);
  return buckets_.row(bucket(steps));
}

double CellSearch::distance(Index place, int side, std::span<const double> point) const {
  const double* plane = sides_.data() + index_of_side(place, side) * (dim_ + 1);
  double sum = plane[dim_];
  for (int a = 0; a < dim_; ++a) sum += plane[a] * point[a];
  return sum;
}

bool CellSearch::is_inside(Index place, std::span<const double> point, double margin) const {
  for (int k = 0; k <= dim_; ++k) {
    if (distance(place, k, point) < margin) return false;
  }
  return true;
}

bool CellSearch::contains(const Vector3& point) const {
  bool found = false;
  for_each_around(point, [&](Index) { found = true; });
  return found;
}

}  // namespace perilink
