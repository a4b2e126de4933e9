#include "analysis/dynamics/time_state.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/saved_states.hpp"

namespace perilink {
namespace {

TEST(TimeState, IsReadAsItWasWritten) {
  TimeState state;
  state.record.load = 0.1;
  state.loop.step = 12;
  state.loop.result.reason = "the whole duration";
  state.bonds.broken = {7, 3};
  state.bonds.elements.intact = {255, 1};
  state.bonds.elements.changed = {1ULL << 40U};
  state.relaxation.is_unstrained = true;
  state.lattice.sums.resize(2);
  state.lattice.sums[1].plastic = -0.0;
  state.lattice.flow.crushed = {1};
  const std::string bytes = test::bytes_of(state);
  const TimeState read = test::state_of(bytes);
  EXPECT_EQ(read.record, state.record);
  EXPECT_EQ(read.loop.step, 12);
  EXPECT_EQ(read.loop.result.reason, "the whole duration");
  EXPECT_EQ(read.bonds.broken, state.bonds.broken);
  EXPECT_EQ(read.bonds.elements.changed, state.bonds.elements.changed);
  EXPECT_TRUE(read.relaxation.is_unstrained);
  EXPECT_TRUE(std::signbit(read.lattice.sums[1].plastic));
  EXPECT_EQ(test::bytes_of(read), bytes);
}

TEST(TimeState, OfAnotherBodyIsRefused) {
  EXPECT_NO_THROW(expect_equal_sizes(3, 3));
  EXPECT_THAT([] { expect_equal_sizes(3, 4); },
              testing::ThrowsMessage<std::invalid_argument>(
                  testing::HasSubstr("another body: it has 3 values instead of 4")));
}

}  // namespace
}  // namespace perilink
