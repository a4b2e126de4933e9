#pragma once

#include <Eigen/Core>

namespace perilink {

/// \file
/// Decompositions of dense matrices, in one file: each takes ten seconds to compile.

/// Returns the eigenvalues of a symmetric matrix, ascending.
Eigen::VectorXd eigenvalues(const Eigen::MatrixXd& symmetric);

/// Returns the eigenvalues of a symmetric tensor in the plane, ascending.
inline Eigen::Vector2d eigenvalues(const Eigen::Matrix2d& symmetric) {
  return eigenvalues(Eigen::MatrixXd(symmetric));
}
/// Returns the eigenvalues of a symmetric tensor in space, ascending.
Eigen::Vector3d eigenvalues(const Eigen::Matrix3d& symmetric);

struct Eigenvectors {
  Eigen::VectorXd values;   ///< ascending
  Eigen::MatrixXd vectors;  ///< in columns, of length one
};
Eigenvectors eigenvectors(const Eigen::MatrixXd& symmetric);

/// Returns the shortest x that minimises |matrix x - wanted|.
/// \param wanted     a vector, or several in columns
/// \param threshold  pivots below this over the largest are none; 0: below round-off
template <class Values>
Values least_squares(const Eigen::MatrixXd& matrix, const Values& wanted, double threshold = 0.0);

/// Returns the Moore-Penrose inverse.
Eigen::MatrixXd pseudo_inverse(const Eigen::MatrixXd& matrix);

/// Returns an x that minimises |matrix x - wanted|.
Eigen::VectorXd least_squares_by_qr(const Eigen::MatrixXd& matrix, const Eigen::VectorXd& wanted);
/// \param ratio  becomes the smallest singular value over the largest
Eigen::VectorXd least_squares_by_svd(const Eigen::MatrixXd& matrix, const Eigen::VectorXd& wanted,
                                     double& ratio);

/// Solves equations with a symmetric positive definite matrix.
/// \param values  right sides in columns, which become the solutions
/// \param least   least pivot over the largest
/// \return whether the pivots are above the least one
bool solve_symmetric(const Eigen::MatrixXd& matrix, Eigen::MatrixXd& values, double least);

/// Returns an orthonormal basis of the vectors at right angles to the columns.
Eigen::MatrixXd complement(const Eigen::MatrixXd& columns);

}  // namespace perilink
