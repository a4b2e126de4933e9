#pragma once

#include <algorithm>
#include <span>

#include <Eigen/Core>

#include "base/types.hpp"
#include "calibration/bounded_least_squares/equations/point_equations.hpp"

namespace perilink {

/// Rigid motions of the box between two corners, about its centre. Rotations are scaled to about
/// one at its boundary.
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

/// Returns multipliers that do no work on any bond. A symmetric third-order tensor Y at each point
/// does work on a bond along n by the difference of Y n n n between its ends. The difference
/// vanishes for products of three rigid motions, Y n n n = (u n) (v n) (w n), since both ends move
/// equally along n. Sums of these Killing tensors are the only smooth fields with this property:
/// ten in the plane, fifty in space (docs/theory/calibration.md).
/// \param equations  with the components of n n n as odd rows, in ascending order
/// \return orthonormal columns, shape (points * rows, fields); fewer fields where points are few or
///     on a line
Eigen::MatrixXd killing_fields(const PointEquations& equations, std::span<const Index> points);

}  // namespace perilink
