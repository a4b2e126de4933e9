#pragma once

#include <Eigen/Core>

/// \file Dense matrices by BLAS and LAPACK, one thread each: results do not depend on their number.

namespace perilink {

/// Before anything calls BLAS: one thread, and the memory that OpenBLAS works in.
/// \throws std::bad_alloc where there is no room for that
void prepare_blas();

/// sum += a b'.
void add_product(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b, Eigen::MatrixXd& sum);

/// Eigenvectors, as columns, of a symmetric matrix with eigenvalues up to `limit`.
/// \throws SolverError where they are not found (numbers that are not finite)
Eigen::MatrixXd eigenvectors_below(Eigen::MatrixXd matrix, double limit);

}  // namespace perilink
