#include "app/process/blas_kernels.hpp"

#include <gtest/gtest.h>

namespace perilink {
namespace {

TEST(BlasKernels, FitProcessorsThatOpenBlasDoesNotKnow) {
  EXPECT_STREQ(fitting_kernels("Prescott", true, true), "SKYLAKEX");
  EXPECT_STREQ(fitting_kernels("Prescott", true, false), "HASWELL");
  EXPECT_STREQ(fitting_kernels("Prescott", false, false), "");
}

TEST(BlasKernels, StayWhereOpenBlasHasChosen) {
  EXPECT_STREQ(fitting_kernels("Zen", true, false), "");
  EXPECT_STREQ(fitting_kernels("SkylakeX", true, true), "");
}

}  // namespace
}  // namespace perilink
