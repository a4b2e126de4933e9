#include "solver/dense/blas_kernels.hpp"

#include <dlfcn.h>
#include <gtest/gtest.h>
#include <strings.h>

#include <cstdlib>

#include "solver/dense/dense_kernels.hpp"

namespace perilink {
namespace {

TEST(BlasKernels, FitProcessorsThatOpenBlasDoesNotKnow) {
  EXPECT_STREQ(fitting_kernels("Prescott", true, true), "SKYLAKEX");
  EXPECT_STREQ(fitting_kernels("Prescott", true, false), "HASWELL");
  EXPECT_STREQ(fitting_kernels("Prescott", false, false), "");
}

TEST(BlasKernels, TakeAvx512WhereOpenBlasHasNotSeenIt) {
  EXPECT_STREQ(fitting_kernels("Zen", true, true), "SKYLAKEX");
  EXPECT_STREQ(fitting_kernels("Haswell", true, true), "SKYLAKEX");
}

TEST(BlasKernels, StayWhereOpenBlasHasChosen) {
  EXPECT_STREQ(fitting_kernels("Zen", true, false), "");
  EXPECT_STREQ(fitting_kernels("Haswell", true, false), "");
  EXPECT_STREQ(fitting_kernels("SkylakeX", true, true), "");
}

/// Nothing better is left to choose once BLAS is prepared, unless the user has chosen.
TEST(BlasKernels, AreTakenBeforeBlasIsUsed) {
  prepare_blas();
  using CoreName = const char* (*)();
  auto* name = reinterpret_cast<CoreName>(dlsym(RTLD_DEFAULT, "openblas_get_corename"));
  if (name == nullptr) GTEST_SKIP() << "BLAS is not OpenBLAS with kernels to choose from";
  const char* named = std::getenv("OPENBLAS_CORETYPE");
  if (named != nullptr && strcasecmp(named, name()) == 0) return;
  EXPECT_STREQ(
      fitting_kernels(name(), __builtin_cpu_supports("avx2"), __builtin_cpu_supports("avx512f")),
      "");
}

}  // namespace
}  // namespace perilink
