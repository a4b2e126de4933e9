#pragma once

#include <algorithm>
#include <span>

#include <Eigen/Core>

#include "base/types.hpp"
#include "calibration/bounded_least_squares/equations/point_equations.hpp"

namespace perilink {

/// Rigid motions of what lies between two corners, about its middle, turns scaled to about one at
/// its rim.
class RigidMotions {
 public:
  RigidMotions(int dim, const Vector3& lower, const Vector3& upper) : dim_(dim) {
    for (int a = 0; a < dim; ++a) {
      middle_[a] = 0.5 * (lower[a] + upper[a]);
      radius_ = std::max(radius_, 0.5 * (upper[a] - lower[a]));
    }
    if (radius_ == 0.0) radius_ = 1.0;
  }

  int count() const { return dim_ == 2 ? 3 : 6; }

  Vector3 at(int motion, std::span<const double> x) const {
    Vector3 value{};
    if (motion < dim_) {
      value[motion] = 1.0;
      return value;
    }
    // Rotation in the plane of two axes.
    const int a = dim_ == 2 ? 0 : (motion + 1) % 3;
    const int b = dim_ == 2 ? 1 : (motion + 2) % 3;
    value[a] = -(x[b] - middle_[b]) / radius_;
    value[b] = (x[a] - middle_[a]) / radius_;
    return value;
  }

 private:
  int dim_;
  Vector3 middle_{};
  double radius_ = 0.0;
};

/// Multipliers that no bond feels: a symmetric tensor Y of third order at each point is felt by a
/// bond along n as the difference of Y n n n between its ends, and that is none for products of
/// three rigid motions, Y n n n = (u n) (v n) (w n), since the motions of the ends along n are the
/// same. These Killing tensors and their sums are all such fields that are smooth: ten in the
/// plane, fifty in space (docs/theory/calibration.md).
/// \param equations  their odd rows are the components of n n n, in ascending order
/// \return orthonormal columns, shape (points * rows, fields); fewer fields where points are few
///         or lie on a line
Eigen::MatrixXd killing_fields(const PointEquations& equations, std::span<const Index> points);

}  // namespace perilink
