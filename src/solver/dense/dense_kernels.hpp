#pragma once

#include <Eigen/Core>

/// \file
/// Dense matrices by BLAS and LAPACK with one thread per call, so that results are
/// independent of the number of threads.

namespace perilink {

/// Sets BLAS to one thread and allocates OpenBLAS's buffers for the given number of calling
/// threads. Must be called before BLAS.
/// \return number of threads with a buffer
/// \throws std::bad_alloc if there is no memory for any buffer
int prepare_blas(int threads = 1);

/// Computes sum += a b'.
void add_product(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b, Eigen::MatrixXd& sum);

/// Returns the eigenvectors, as columns, of a positive semidefinite matrix with eigenvalues up to
/// `limit`, by subspace inverse iteration. Vectors far below the limit are exact, vectors near it
/// are mixed with their neighbours.
/// \param expected  approximate number of vectors, the first size of the subspace
/// \throws SolverError if the vectors are not found or the matrix is not finite
Eigen::MatrixXd eigenvectors_below(const Eigen::MatrixXd& matrix, double limit, int expected);

}  // namespace perilink
