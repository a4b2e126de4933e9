#include "base/huge_pages.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

namespace perilink {
namespace {

/// What the system knows of the memory that an address is in; empty: it does not tell.
std::string flags_of(const void* address) {
  const auto place = reinterpret_cast<std::uintptr_t>(address);
  std::ifstream file("/proc/self/smaps");
  bool is_here = false;
  for (std::string line; std::getline(file, line);) {
    std::uintptr_t begin = 0, end = 0;
    char dash = 0;
    std::istringstream range(line);
    if (range >> std::hex >> begin >> dash >> end && dash == '-') {
      is_here = begin <= place && place < end;
    }
    if (is_here && line.starts_with("VmFlags:")) return line + " ";
  }
  return {};
}

bool are_asked_for(const void* address) {
  return flags_of(address).find(" hg ") != std::string::npos;
}

/// Whether the system has huge pages for those who ask.
bool can_be_had() {
  std::ifstream file("/sys/kernel/mm/transparent_hugepage/enabled");
  std::string words;
  std::getline(file, words);
  return words.find("[never]") == std::string::npos && !words.empty();
}

TEST(HugePages, AreAskedForWhereVectorsAreLarge) {
  if (!can_be_had()) GTEST_SKIP() << "this system has none";
  const std::vector<double> large(std::size_t{8} << 20, 1.0);
#ifndef __SANITIZE_ADDRESS__  // which has an operator new of its own
  EXPECT_TRUE(are_asked_for(large.data() + large.size() / 2));
#endif
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
