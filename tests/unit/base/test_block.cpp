#include "base/block.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <utility>

namespace perilink {
namespace {

template <class Number>
bool begins_at_line(const BlockVector<Number>& block) {
  return reinterpret_cast<std::uintptr_t>(block.data()) % 64 == 0;
}

TEST(Block, BeginsAtALineOfTheCache) {
  for (const std::size_t size : {1, 7, 16, 1000, 100'000}) {
    BlockVector<double> numbers(size, 1.0);
    EXPECT_TRUE(begins_at_line(numbers)) << size;
    BlockVector<float> others(size, 2.0F);
    EXPECT_TRUE(begins_at_line(others)) << size;
    numbers.resize(3 * size, 1.0);
    EXPECT_TRUE(begins_at_line(numbers)) << size;
    const BlockVector<double> moved = std::move(numbers);
    EXPECT_EQ(moved, BlockVector<double>(3 * size, 1.0));
  }
}

}  // namespace
}  // namespace perilink
