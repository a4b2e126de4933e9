#include "solver/dense/blas_kernels.hpp"

#include <dlfcn.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <string>

#include <Eigen/Core>

#include "solver/dense/dense_kernels.hpp"

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

/// OpenBLAS is made to take those of 2004, as on a processor that it does not know.
TEST(BlasKernels, AreTakenInPlaceOfThoseOf2004) {
#ifdef __x86_64__
  using CoreName = const char* (*)();
  using Call = void (*)();
  auto* name = reinterpret_cast<CoreName>(dlsym(RTLD_DEFAULT, "openblas_get_corename"));
  auto* forget = reinterpret_cast<Call>(dlsym(RTLD_DEFAULT, "gotoblas_dynamic_quit"));
  auto* choose = reinterpret_cast<Call>(dlsym(RTLD_DEFAULT, "gotoblas_dynamic_init"));
  if (name == nullptr || forget == nullptr || choose == nullptr) GTEST_SKIP() << "no choice";
  if (!__builtin_cpu_supports("avx2")) GTEST_SKIP() << "there are none";
  prepare_blas();
  const char* setting = std::getenv("OPENBLAS_CORETYPE");
  const std::string before = setting == nullptr ? "" : setting;
  setenv("OPENBLAS_CORETYPE", "Prescott", 1);
  forget();
  choose();
  ASSERT_STREQ(name(), "Prescott");
  use_fitting_kernels();
  EXPECT_STREQ(name(), "Prescott") << "the user has named some";
  unsetenv("OPENBLAS_CORETYPE");
  use_fitting_kernels();
  EXPECT_STRNE(name(), "Prescott");
  const Eigen::MatrixXd one = Eigen::MatrixXd::Constant(40, 30, 1.0);
  Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(40, 40);
  add_product(one, one, sum);
  EXPECT_EQ(sum, Eigen::MatrixXd::Constant(40, 40, 30.0));
  if (!before.empty()) setenv("OPENBLAS_CORETYPE", before.c_str(), 1);
#endif
}

TEST(BlasKernels, SayHowManyThreadsTheyServe) {
  EXPECT_EQ(most_blas_threads("OpenBLAS 0.3.21 DYNAMIC_ARCH Haswell MAX_THREADS=64"), 64);
  EXPECT_GT(most_blas_threads("OpenBLAS 0.3.21 SINGLE_THREADED"), 1000000);
  EXPECT_GT(most_blas_threads(), 1);
}

}  // namespace
}  // namespace perilink
