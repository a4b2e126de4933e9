#include "base/memory.hpp"

#include <gtest/gtest.h>

#include <new>
#include <stdexcept>

namespace perilink {
namespace {

TEST(Memory, SomeIsLeft) { EXPECT_GT(available_memory(), 1e6); }

TEST(Memory, IsWrittenInUnitsOfPeople) {
  EXPECT_EQ(bytes_text(1.5e9), "1.5 GB");
  EXPECT_EQ(bytes_text(12e6), "12 MB");
  EXPECT_EQ(bytes_text(1.0), "1 MB") << "never none";
}

TEST(Memory, ItsLackIsToldInWords) {
  EXPECT_EQ(failure_text(std::runtime_error("the disk is full")), "the disk is full");
  const std::string text = failure_text(std::bad_alloc());
  EXPECT_EQ(text.find("out of memory: "), 0u);
  EXPECT_EQ(text.find("bad_alloc"), std::string::npos);
  EXPECT_NE(text.find("MB"), text.find("GB")) << text;
}

}  // namespace
}  // namespace perilink
