// This test program is linked with the operator new of the programs.

#include <gtest/gtest.h>

#include <vector>

#include "support/huge_page_flags.hpp"

namespace perilink {
namespace {

TEST(OperatorNew, AsksForHugePagesForLargeVectors) {
#ifdef __SANITIZE_ADDRESS__
  GTEST_SKIP() << "AddressSanitizer has an operator new of its own";
#endif
  if (!test::can_be_had()) GTEST_SKIP() << "this system has none";
  const std::vector<double> large(std::size_t{8} << 20, 1.0);
  EXPECT_TRUE(test::are_asked_for(large.data() + large.size() / 2));
}

}  // namespace
}  // namespace perilink
