#include "discretization/region.hpp"

#include <cmath>

namespace perilink {

bool Box::contains(std::span<const double> point, double tolerance) const {
  for (std::size_t axis = 0; axis < point.size(); ++axis) {
    if (point[axis] < lower[axis] - tolerance || point[axis] > upper[axis] + tolerance) {
      return false;
    }
  }
  return true;
}

double Round::distance(std::span<const double> point) const {
  double square = 0.0;
  for (std::size_t a = 0; a < point.size(); ++a) {
    if (axis && static_cast<std::size_t>(*axis) == a) continue;
    square += (point[a] - center[a]) * (point[a] - center[a]);
  }
  return std::sqrt(square) - radius;
}

bool Region::contains(std::span<const double> point, double tolerance) const {
  if (!box.contains(point, tolerance)) return false;
  return !round || round->distance(point) <= tolerance;
}

}  // namespace perilink
