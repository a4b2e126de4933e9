#pragma once

#include <cholmod.h>

#include <span>

#include "solver/supernodes/sparse_matrix.hpp"

namespace perilink {

/// The numbers of a supernodal factor L L' whose pattern CHOLMOD has analysed: left-looking,
/// supernode by supernode (Ng & Peyton 1993). Threads share the independent subtrees of the
/// elimination tree, and above these the rows of large supernodes. Which pieces there are depends
/// on the pattern alone, and each is computed by one thread: any number of threads gives the same
/// bytes.
/// \param add     the matrix, which need not be stored
/// \param values  where those of each supernode go, in double or single precision, shape (count,
///                columns) each
/// \throws SolverError  where there is no memory
/// \return the first column at which the matrix is not positive definite; n where it is
template <class Number>
Index factorize_supernodes(const AddColumn& add, const cholmod_factor& factor,
                           std::span<Number* const> values, int threads);

}  // namespace perilink
