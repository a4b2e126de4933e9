#pragma once

#include <string_view>

namespace perilink {

/// Kernels of OpenBLAS for a processor that it does not know: it then takes those of 2004, which
/// factorise 2.5 times slower. Empty: those that it has taken are good.
/// \param taken  name of those that it has taken
const char* fitting_kernels(std::string_view taken, bool has_avx2, bool has_avx512);

/// Has OpenBLAS take these kernels, unless OPENBLAS_CORETYPE names some. Nobody may be in it.
void use_fitting_kernels();

/// Threads that may be in OpenBLAS at once: beyond them it runs out of buffers and destroys the
/// heap.
int most_blas_threads();
/// The limit that a description of OpenBLAS names; without one, none that matters.
int most_blas_threads(std::string_view config);

}  // namespace perilink
