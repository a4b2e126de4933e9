#pragma once

#include "base/types.hpp"

/// \file
/// Dense kernels on one supernode of a factor L D L'. A supernode is a trapezoid of `columns`
/// columns and `rows` rows, column-major with leading dimension `rows`: unit lower triangle on top,
/// D stored on the diagonal, whatever CHOLMOD left above the diagonal never read. `local` is the
/// part of a vector that belongs to the supernode's rows. Each kernel reads L once, in order: they
/// run at the speed of memory once the factor is larger than the caches. L may be in single
/// precision (Number is float); what is computed with it is not.

namespace perilink::supernodal {

/// Forward elimination: on entry local = w on the supernode's rows; on return the first `columns`
/// entries hold p = L11^-1 w1 and the rest w2 - L21 p. Starts at column `start` (entries above it
/// must be zero).
template <class Number>
void forward(const Number* block, Index rows, Index columns, Index start, double* local);

/// Backward substitution: on entry local holds z on the columns and the solution on the rows below;
/// on return the columns hold the solution y1 = L11^-T (z1 - L21' y2).
template <class Number>
void backward(const Number* block, Index rows, Index columns, double* local);

/// Backward substitution as above with the old columns, and at the same time the rank-one change
/// that turns them into the columns of L D L' - x x' (Gill, Golub, Murray & Saunders 1974, method
/// C1): with p = L^-1 x known, column j becomes l_j + beta_j w_j, where w_j is x less its
/// eliminations by columns up to j. Going down from the last column, w is won back from p:
/// w_(j-1) = w_j + p_j l_j. One pass over the block does what three would. The diagonal is not
/// touched.
/// \param p      p on the columns, size `columns`
/// \param beta   beta on the columns, size `columns`
/// \param local  as in backward()
/// \param w      on entry w left after the last column, on the rows; on return w before the first
void backward_and_change(double* block, Index rows, Index columns, const double* p,
                         const double* beta, double* local, double* w);

/// Vectors that change_together() takes at once.
inline constexpr Index most_together = 16;

/// The rank-one changes L D L' - w w' of several vectors one after the other, with L read once
/// (Gill, Golub, Murray & Saunders 1974, method C1): for each column j and each w, d_j becomes
/// d_j + sigma p^2 with p = w_j, w becomes w - p l_j and l_j becomes l_j + beta w, with
/// beta = sigma p / d_j of the new d_j.
/// \param count  number of vectors, most_together at most
/// \param w      the vectors, shape (count, rows); on return without what the columns eliminate
/// \param sigma  one number per vector, -1 before its first column; behind its last column
///               -1 / sigma is the pivot 1 - x' K^-1 x, K with the changes by the vectors before it
/// \return false where D does not stay positive: the block is then spoilt
bool change_together(double* block, Index rows, Index columns, Index count, double* w,
                     double* sigma);

}  // namespace perilink::supernodal
