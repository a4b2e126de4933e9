#include "discretization/outline.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>

namespace perilink {
namespace {

/// Returns distinct lower and upper coordinates along an axis, ascending.
std::vector<double> planes(std::span<const Box> boxes, int axis, double tolerance) {
  std::vector<double> all;
  for (const Box& box : boxes) {
    all.push_back(box.lower[axis]);
    all.push_back(box.upper[axis]);
  }
  std::sort(all.begin(), all.end());
  std::vector<double> distinct;
  for (const double coordinate : all) {
    if (distinct.empty() || coordinate - distinct.back() > tolerance) {
      distinct.push_back(coordinate);
    }
  }
  return distinct;
}

}  // namespace

Outline make_outline(std::span<const Box> boxes, int dim, double tolerance) {
  if (boxes.empty()) throw std::invalid_argument("the body is empty: no region is solid");
  Outline outline;
  outline.dim = dim;
  outline.cuts[2] = {0.0, 1.0};  // one layer in two dimensions
  for (int axis = 0; axis < dim; ++axis) {
    for (const Box& box : boxes) {
      if (box.upper[axis] - box.lower[axis] <= tolerance) {
        throw std::invalid_argument("a region of the body has no extent along axis " +
                                    std::string(1, "xyz"[axis]));
      }
    }
    outline.cuts[axis] = planes(boxes, axis, tolerance);
    outline.bounds.lower[axis] = outline.cuts[axis].front();
    outline.bounds.upper[axis] = outline.cuts[axis].back();
  }
  const auto& cuts = outline.cuts;
  for (Index k = 0; k < outline.cells(2); ++k) {
    for (Index j = 0; j < outline.cells(1); ++j) {
      for (Index i = 0; i < outline.cells(0); ++i) {
        const Vector3 centre = {0.5 * (cuts[0][i] + cuts[0][i + 1]),
                                0.5 * (cuts[1][j] + cuts[1][j + 1]),
                                0.5 * (cuts[2][k] + cuts[2][k + 1])};
        const std::span<const double> point(centre.data(), static_cast<std::size_t>(dim));
        outline.occupied.push_back(std::any_of(
            boxes.begin(), boxes.end(), [&](const Box& box) { return box.contains(point, 0.0); }));
      }
    }
  }
  return outline;
}

double volume(const Outline& outline) {
  const auto& cuts = outline.cuts;
  double sum = 0.0;
  for (Index k = 0; k < outline.cells(2); ++k) {
    for (Index j = 0; j < outline.cells(1); ++j) {
      for (Index i = 0; i < outline.cells(0); ++i) {
        if (!outline.cell(i, j, k)) continue;
        sum += (cuts[0][i + 1] - cuts[0][i]) * (cuts[1][j + 1] - cuts[1][j]) *
               (cuts[2][k + 1] - cuts[2][k]);
      }
    }
  }
  return sum;
}

std::vector<double> faces(const Outline& outline, int axis) {
  const int other = (axis + 1) % 3;
  const int third = (axis + 2) % 3;
  std::vector<double> found;
  for (Index plane = 0; plane <= outline.cells(axis); ++plane) {
    bool is_face = false;
    for (Index a = 0; a < outline.cells(other) && !is_face; ++a) {
      for (Index b = 0; b < outline.cells(third) && !is_face; ++b) {
        std::array<Index, 3> above{};
        above[axis] = plane;
        above[other] = a;
        above[third] = b;
        std::array<Index, 3> below = above;
        below[axis] = plane - 1;
        is_face = outline.cell(above[0], above[1], above[2]) !=
                  outline.cell(below[0], below[1], below[2]);
      }
    }
    if (is_face) found.push_back(outline.cuts[axis][plane]);
  }
  return found;
}

}  // namespace perilink
