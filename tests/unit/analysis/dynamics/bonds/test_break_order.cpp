#include "analysis/dynamics/bonds/break_order.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace perilink {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

TEST(BreakOrder, IsThatOfTheStepsAndInAStepThatOfTheNumbers) {
  BreakOrder order(3);
  EXPECT_THAT(order.so_far(), IsEmpty());
  order.add(2, 5, std::vector<Index>{40, 7});
  order.add(0, 6, std::vector<Index>{1});
  order.add(0, 7, std::vector<Index>{50, 3});
  order.add(1, 5, std::vector<Index>{9});
  order.add(1, 6, {});
  EXPECT_THAT(order.so_far(), ElementsAre(7, 9, 40, 1, 3, 50));
  order.add(1, 8, std::vector<Index>{2});
  EXPECT_THAT(order.so_far(), ElementsAre(7, 9, 40, 1, 3, 50, 2));
}

TEST(BreakOrder, CountsBothHalvesOfABondOnce) {
  BreakOrder order(2);
  order.add(0, 5, std::vector<Index>{4, 4});
  order.add(0, 6, std::vector<Index>{8});
  order.add(1, 6, std::vector<Index>{8});
  EXPECT_THAT(order.so_far(), ElementsAre(4, 8));
  order.add(1, 7, std::vector<Index>{4, 2});  // a step later, after a call of so_far()
  EXPECT_THAT(order.so_far(), ElementsAre(4, 8, 2));
}

TEST(BreakOrder, TellsWhatIsNew) {
  BreakOrder order(2);
  order.add(1, 3, std::vector<Index>{9, 4});
  order.add(0, 3, std::vector<Index>{6});
  const auto latest = order.take_latest();
  EXPECT_THAT(latest, ElementsAre(BreakOrder::Break{3, 4}, BreakOrder::Break{3, 6},
                                  BreakOrder::Break{3, 9}));
  EXPECT_THAT(order.take_latest(), IsEmpty());
}

TEST(BreakOrder, GoesOnAfterSavedBreaks) {
  BreakOrder order(2);
  order.restore({7, 3});
  order.add(1, 9, std::vector<Index>{5, 3, 1});
  EXPECT_THAT(order.so_far(), ElementsAre(7, 3, 1, 5));
}

}  // namespace
}  // namespace perilink
