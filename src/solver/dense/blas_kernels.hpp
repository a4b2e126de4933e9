#pragma once

#include <string_view>

namespace perilink {

/// Returns the name of better OpenBLAS kernels for a processor that OpenBLAS does not recognise;
/// empty if its choice is good. On unknown processors it uses kernels of 2004, which factorise 2.5
/// times slower.
/// \param taken  name of the chosen kernels
const char* fitting_kernels(std::string_view taken, bool has_avx2, bool has_avx512);

/// Makes OpenBLAS use the better kernels, unless OPENBLAS_CORETYPE is set. No thread may be in
/// OpenBLAS.
void use_fitting_kernels();

/// Returns the largest number of threads that may be in OpenBLAS at once. More threads exhaust its
/// buffers and corrupt the heap.
int most_blas_threads();
/// Returns the limit in a description of OpenBLAS; the largest int without one.
int most_blas_threads(std::string_view config);

}  // namespace perilink
