#pragma once

#include "base/types.hpp"

/// \file
/// Dense kernels on one supernode of a factor L D L'. A supernode is a trapezoid of `columns` columns
/// and `rows` rows, column-major with leading dimension `rows`: unit lower triangle on top, D stored
/// on the diagonal, whatever CHOLMOD left above the diagonal never read. `local` is the part of a
/// vector that belongs to the supernode's rows. Each kernel reads L once, in order: they run at the
/// speed of memory once the factor is larger than the caches.

namespace perilink::supernodal {

/// Forward elimination: on entry local = w on the supernode's rows; on return the first `columns`
/// entries hold p = L11^-1 w1 and the rest w2 - L21 p. Starts at column `start` (entries above it
/// must be zero).
void forward(const double* block, Index rows, Index columns, Index start, double* local);

/// Backward substitution: on entry local holds z on the columns and the solution on the rows below;
/// on return the columns hold the solution y1 = L11^-T (z1 - L21' y2).
void backward(const double* block, Index rows, Index columns, double* local);

/// Rank-one change of the columns from `start` on (Gill, Golub, Murray & Saunders 1974, method C1):
/// with p = L^-1 x known, column j becomes l_j + beta_j w, w the part of x not yet eliminated. The
/// diagonal is not touched here.
/// \param p      p on the columns, size `columns`
/// \param beta   beta on the columns, size `columns`
/// \param local  on entry w on the rows; on return the w that is left below the supernode
void change(double* block, Index rows, Index columns, Index start, const double* p,
            const double* beta, double* local);

}  // namespace perilink::supernodal
