#include "base/huge_pages.hpp"

#include <gtest/gtest.h>

#include <cstdlib>

#include "support/huge_page_flags.hpp"

namespace perilink {
namespace {

using test::are_asked_for;
using test::can_be_had;

TEST(HugePages, AreAskedForWhereBlocksAreLarge) {
  if (!can_be_had()) GTEST_SKIP() << "this system has none";
  void* memory = allocate_memory(std::size_t{64} << 20);
  ASSERT_NE(memory, nullptr);
  EXPECT_TRUE(are_asked_for(static_cast<char*>(memory) + (1 << 20)));
  std::free(memory);
}

TEST(HugePages, EveryPieceIsOne) {
  void* memory = allocate_memory(0);
  EXPECT_NE(memory, nullptr);
  std::free(memory);
#ifndef __SANITIZE_ADDRESS__  // which ends the program there
  EXPECT_EQ(allocate_memory(~std::size_t{0} / 2), nullptr) << "more than there is";
#endif
}

}  // namespace
}  // namespace perilink
