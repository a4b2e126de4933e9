#include "discretization/region.hpp"

namespace perilink {

bool Box::contains(std::span<const double> point, double tolerance) const {
  for (std::size_t axis = 0; axis < point.size(); ++axis) {
    if (point[axis] < lower[axis] - tolerance || point[axis] > upper[axis] + tolerance) {
      return false;
    }
  }
  return true;
}

}  // namespace perilink
