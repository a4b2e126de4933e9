#pragma once

#include <Eigen/Core>

/// \file Dense matrices by BLAS and LAPACK, one thread each: results do not depend on their number.

namespace perilink {

/// OpenBLAS splits sums by its number of threads, which would make results depend on it: one
/// thread. Other BLAS libraries lack the function; the reference BLAS has one thread anyway.
void use_one_blas_thread();

/// sum += a b'.
void add_product(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b, Eigen::MatrixXd& sum);

/// Eigenvectors, as columns, of a symmetric matrix with eigenvalues up to `limit`.
/// \throws SolverError where they are not found (numbers that are not finite)
Eigen::MatrixXd eigenvectors_below(Eigen::MatrixXd matrix, double limit);

}  // namespace perilink
