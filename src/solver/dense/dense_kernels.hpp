#pragma once

#include <Eigen/Core>

/// \file Dense matrices by BLAS and LAPACK, one thread each: results do not depend on their number.

namespace perilink {

/// Before anything calls BLAS: one thread, and the memory that OpenBLAS works in for so many of
/// ours that call it at once.
/// \return for how many there is room
/// \throws std::bad_alloc where there is none
int prepare_blas(int threads = 1);

/// sum += a b'.
void add_product(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b, Eigen::MatrixXd& sum);

/// Eigenvectors, as columns, of a positive semidefinite matrix with eigenvalues up to `limit`, by
/// inverse iteration of a subspace: those far below the limit are exact, those near it a mixture of
/// their neighbours.
/// \param expected  about how many there are: a subspace so large is tried first
/// \throws SolverError where they are not found (numbers that are not finite)
Eigen::MatrixXd eigenvectors_below(const Eigen::MatrixXd& matrix, double limit, int expected);

}  // namespace perilink
