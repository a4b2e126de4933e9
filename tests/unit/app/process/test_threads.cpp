#include "app/process/threads.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "solver/dense/blas_kernels.hpp"
#include "support/process.hpp"
#include "support/temporary_directory.hpp"

namespace perilink {
namespace {

TEST(Threads, ContainersGrantProcessors) {
  const test::TemporaryDirectory cgroups;
  const std::string root = cgroups.path().string();
  EXPECT_TRUE(std::isinf(granted_processors(root)));
  std::filesystem::create_directories(cgroups / "cpu");
  test::write_text(cgroups / "cpu/cpu.cfs_quota_us", "-1\n");
  test::write_text(cgroups / "cpu/cpu.cfs_period_us", "100000\n");
  EXPECT_TRUE(std::isinf(granted_processors(root)));
  test::write_text(cgroups / "cpu/cpu.cfs_quota_us", "250000\n");
  EXPECT_EQ(granted_processors(root), 2.5);
  test::write_text(cgroups / "cpu.max", "150000 100000\n");
  EXPECT_EQ(granted_processors(root), 1.5);
  test::write_text(cgroups / "cpu.max", "max 100000\n");
  std::filesystem::remove_all(cgroups / "cpu");
  EXPECT_TRUE(std::isinf(granted_processors(root)));
}

TEST(Threads, AreAsManyAsAreWanted) {
  EXPECT_GE(default_threads(), 1);
  EXPECT_EQ(set_threads(1), 1);
  EXPECT_GE(set_threads(0), 1);
}

/// Beyond what the linear algebra library serves it would destroy the heap.
TEST(Threads, AreNoMoreThanTheLibrariesServe) {
  EXPECT_LE(set_threads(100000), std::min(1024, most_blas_threads()));
  set_threads(1);
}

}  // namespace
}  // namespace perilink
