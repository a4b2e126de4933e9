#pragma once

#include "base/types.hpp"

/// \file
/// Dense kernels on one supernode of a factor L D L'. A supernode is a trapezoid of `columns`
/// columns and `rows` rows, column-major with leading dimension `rows`. Its top is a unit lower
/// triangle with D on the diagonal. Numbers above the diagonal are never read. `local` is the part
/// of a vector on the supernode's rows. Each kernel reads L once, in order. Memory bandwidth limits
/// its speed for factors larger than the caches. L may be in single precision (Number is float);
/// the arithmetic is in double precision.

namespace perilink::supernodal {

/// Forward elimination. On entry local = w on the supernode's rows. On return the first `columns`
/// entries hold p = L11^-1 w1 and the others w2 - L21 p. Starts at column `start`; entries above it
/// must be zero.
template <class Number>
void forward(const Number* block, Index rows, Index columns, Index start, double* local);

/// Backward substitution. On entry local holds z on the columns and the solution on the rows below.
/// On return the columns hold the solution y1 = L11^-T (z1 - L21' y2).
template <class Number>
void backward(const Number* block, Index rows, Index columns, double* local);

/// Backward substitution with the old columns as in backward(), combined with the rank-one change
/// of the columns for L D L' - x x'. Source: Gill, Golub, Murray & Saunders 1974, method C1. With p
/// = L^-1 x, column j becomes l_j + beta_j w_j, where w_j is x reduced by columns up to j. From the
/// last column backward, w follows from p: w_(j-1) = w_j + p_j l_j. One pass over the block
/// replaces three. The diagonal stays unchanged.
/// \param p      p on the columns, size `columns`
/// \param beta   beta on the columns, size `columns`
/// \param local  as in backward()
/// \param w      on entry w after the last column, on the rows; on return w before the first
void backward_and_change(double* block, Index rows, Index columns, const double* p,
                         const double* beta, double* local, double* w);

/// Largest number of vectors of one call of change_together().
inline constexpr Index most_together = 16;

/// Rank-one changes L D L' - w w' of several vectors, one after another, in one pass over L (Gill,
/// Golub, Murray & Saunders 1974, method C1). For each column j and each w, d_j becomes d_j + sigma
/// p^2 with p = w_j. Then w becomes w - p l_j, and l_j becomes l_j + beta w, with beta = sigma p /
/// d_j of the new d_j.
/// \param count  number of vectors, at most most_together
/// \param w      vectors, shape (count, rows); on return reduced by the columns
/// \param sigma  one number per vector, -1 before its first column. After its last column -1 /
///     sigma is the pivot 1 - x' K^-1 x; K includes the changes by earlier vectors.
/// \return false if D does not stay positive; the block is then invalid
bool change_together(double* block, Index rows, Index columns, Index count, double* w,
                     double* sigma);

}  // namespace perilink::supernodal
