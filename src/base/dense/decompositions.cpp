#include "base/dense/decompositions.hpp"

#include <Eigen/Dense>

namespace perilink {

using Eigen::MatrixXd;
using Eigen::VectorXd;

VectorXd eigenvalues(const MatrixXd& symmetric) {
  return Eigen::SelfAdjointEigenSolver<MatrixXd>(symmetric, Eigen::EigenvaluesOnly).eigenvalues();
}

Eigen::Vector3d eigenvalues(const Eigen::Matrix3d& symmetric) {
  return Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(symmetric, Eigen::EigenvaluesOnly)
      .eigenvalues();
}

Eigenvectors eigenvectors(const MatrixXd& symmetric) {
  const Eigen::SelfAdjointEigenSolver<MatrixXd> solver(symmetric);
  return {solver.eigenvalues(), solver.eigenvectors()};
}

template <class Values>
Values least_squares(const MatrixXd& matrix, const Values& wanted, double threshold) {
  Eigen::CompleteOrthogonalDecomposition<MatrixXd> factor;
  if (threshold > 0.0) factor.setThreshold(threshold);
  return factor.compute(matrix).solve(wanted);
}
template VectorXd least_squares(const MatrixXd&, const VectorXd&, double);
template MatrixXd least_squares(const MatrixXd&, const MatrixXd&, double);

MatrixXd pseudo_inverse(const MatrixXd& matrix) {
  return least_squares<MatrixXd>(matrix, MatrixXd::Identity(matrix.rows(), matrix.rows()));
}

VectorXd least_squares_by_qr(const MatrixXd& matrix, const VectorXd& wanted) {
  return matrix.colPivHouseholderQr().solve(wanted);
}

VectorXd least_squares_by_svd(const MatrixXd& matrix, const VectorXd& wanted, double& ratio) {
  const Eigen::JacobiSVD<MatrixXd> svd(matrix, Eigen::ComputeThinU | Eigen::ComputeThinV);
  const VectorXd& values = svd.singularValues();
  ratio = values[values.size() - 1] / values[0];
  return svd.solve(wanted);
}

bool solve_symmetric(const MatrixXd& matrix, MatrixXd& values, double least) {
  const Eigen::LDLT<MatrixXd> factor(matrix);
  const auto pivots = factor.vectorD();
  if (!(pivots.minCoeff() > least * pivots.maxCoeff())) return false;
  values = factor.solve(values).eval();
  return true;
}

MatrixXd complement(const MatrixXd& columns) {
  const Eigen::Index rows = columns.rows();
  return Eigen::HouseholderQR<MatrixXd>(columns).householderQ() *
         MatrixXd::Identity(rows, rows).rightCols(rows - columns.cols());
}

}  // namespace perilink
