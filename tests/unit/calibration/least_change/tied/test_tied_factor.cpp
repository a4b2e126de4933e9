#include "calibration/least_change/tied/tied_factor.hpp"

#include <gtest/gtest.h>

#include "calibration/least_change/tied/tie.hpp"
#include "support/point_equations.hpp"

namespace perilink {
namespace {

using test::two_weights;

/// The same factor serves behind bonds that are gone, not for rows that it does not have.
TEST(TiedFactor, FitsEquationsWithFewerRows) {
  TiedRows bases, others;
  const TiedEquations one = tie(two_weights({1.0, 1.0, 1.0, 1.0}, {2.0, 2.0}), others);
  const TiedEquations two = tie(two_weights({1.0, 1.0, 1.0, 2.0}, {2.0, 3.0}), bases);
  const TiedEquations::Matrix columns_of_two = two.matrix.transpose();
  const TiedEquations::Matrix columns_of_one = one.matrix.transpose();
  TiedFactor large(two, columns_of_two), small(one, columns_of_one);
  EXPECT_TRUE(large.fits(one, columns_of_one));
  EXPECT_FALSE(small.fits(two, columns_of_two));
  const std::vector<double> mobility = {1.0, 1.0}, shift = {0.0, 0.0}, right = {4.0, 0.0};
  std::vector<double> result(2);
  small.factorize(columns_of_one, mobility, shift);
  small.solve(right, result);
  EXPECT_NEAR(result[0], 1.0, 1e-11);  // the row that is left has the square 4
  EXPECT_EQ(result[1], 0.0);
}

}  // namespace
}  // namespace perilink
