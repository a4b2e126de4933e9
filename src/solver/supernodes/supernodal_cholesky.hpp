#pragma once

#include <cholmod.h>

#include "solver/supernodes/sparse_matrix.hpp"

namespace perilink {

/// The numbers of a supernodal factor L L' whose pattern CHOLMOD has analysed: left-looking,
/// supernode by supernode (Ng & Peyton 1993). Threads share the independent subtrees of the
/// elimination tree, and above these the rows of large supernodes. Which pieces there are depends
/// on the pattern alone, and each is computed by one thread: any number of threads gives the same
/// bytes.
/// \param lower  lower triangle in the order of the factor, shape (n, n)
/// \param values  those of L, in double or single precision, shape (factor.xsize)
/// \throws SolverError  where there is no memory
/// \return the first column at which the matrix is not positive definite; n where it is
template <class Number>
Index factorize_supernodes(const SparseMatrix& lower, const cholmod_factor& factor, Number* values,
                           int threads);

}  // namespace perilink
