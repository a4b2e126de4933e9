#include "material/principal_values.hpp"

#include <Eigen/Dense>
#include <cmath>

namespace perilink {
namespace {

Eigen::Matrix3d matrix_of(const SymmetricTensor& t) {
  Eigen::Matrix3d matrix;
  matrix << t[0], t[3], t[5], t[3], t[1], t[4], t[5], t[4], t[2];
  return matrix;
}

}  // namespace

void add_square(SymmetricTensor& tensor, double factor, const Vector3& v) {
  for (int a = 0; a < 3; ++a) {
    tensor[a] += factor * v[a] * v[a];
    tensor[3 + a] += factor * v[a] * v[(a + 1) % 3];
  }
}

PrincipalValues principal_values(const SymmetricTensor& tensor, int dim) {
  if (dim == 2) {
    const double mean = 0.5 * (tensor[0] + tensor[1]), half = 0.5 * (tensor[0] - tensor[1]);
    const double radius = std::hypot(half, tensor[3]);
    return {mean + radius, mean - radius, mean - radius};
  }
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver;
  solver.computeDirect(matrix_of(tensor), Eigen::EigenvaluesOnly);
  const auto& values = solver.eigenvalues();
  return {values[2], values[1], values[0]};
}

Vector3 principal_direction(const SymmetricTensor& tensor, int dim) {
  if (dim == 2) {
    const double angle = 0.5 * std::atan2(tensor[3], 0.5 * (tensor[0] - tensor[1]));
    return {std::cos(angle), std::sin(angle), 0.0};
  }
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver;
  solver.computeDirect(matrix_of(tensor));
  const Eigen::Vector3d axis = solver.eigenvectors().col(2);
  return {axis[0], axis[1], axis[2]};
}

}  // namespace perilink
