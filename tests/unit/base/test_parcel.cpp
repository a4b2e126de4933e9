#include "base/parcel.hpp"

#include <gtest/gtest.h>

namespace perilink {
namespace {

TEST(Parcel, GivesBackWhatWasPutIn) {
  Parcel parcel;
  parcel.put(3.5);
  parcel.put(std::vector<int>{1, 2, 3});
  parcel.put(std::vector<double>{});
  parcel.put('x');
  Parcel arrived(std::vector<std::byte>(parcel.bytes().begin(), parcel.bytes().end()));
  EXPECT_EQ(arrived.get<double>(), 3.5);
  std::vector<int> numbers;
  arrived.get(numbers);
  EXPECT_EQ(numbers, (std::vector<int>{1, 2, 3}));
  std::vector<double> none{1.0};
  arrived.get(none);
  EXPECT_TRUE(none.empty());
  EXPECT_EQ(arrived.get<char>(), 'x');
}

}  // namespace
}  // namespace perilink
