#pragma once

#include <cholmod.h>

#include <span>

#include "solver/supernodes/sparse_matrix.hpp"

namespace perilink {

/// Computes a supernodal factor L L' on the pattern that CHOLMOD has analysed: left-looking, one
/// supernode after another (Ng & Peyton 1993). Threads share the independent subtrees of the
/// elimination tree and, above these, the rows of large supernodes. The division depends only on
/// the pattern, and each piece is computed by one thread. Any number of threads therefore gives
/// identical bytes.
/// \param add     columns of the matrix, which need not be stored
/// \param values  output per supernode in double or single precision, shape (count, columns) each
/// \throws SolverError if memory is too small
/// \return first column at which the matrix is not positive definite; n if it is
template <class Number>
Index factorize_supernodes(const AddColumn& add, const cholmod_factor& factor,
                           std::span<Number* const> values, int threads);

}  // namespace perilink
