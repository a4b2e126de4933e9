#include "base/vector_span.hpp"

#include <gtest/gtest.h>

#include <map>

namespace perilink {
namespace {

/// What the parts come to, by unknown.
std::map<Index, double> sum_of(const std::vector<VectorSpan::Part>& parts,
                               const std::vector<SparseVector>& vectors) {
  std::map<Index, double> sum;
  for (const auto& [number, share] : parts) {
    const SparseVector& x = vectors.at(number);
    for (int k = 0; k < x.size(); ++k) sum[x.rows[k]] += share * x.values[k];
  }
  return sum;
}

TEST(VectorSpan, FindsWhatAVectorIsMadeOf) {
  const std::vector<SparseVector> vectors = {
      {{4, 9}, {2.0, -1.0}}, {{9, 2}, {3.0, 5.0}}, {{7}, {1.0}}};
  VectorSpan span;
  for (Index k = 0; k < 3; ++k) span.add(vectors[k], k);
  const SparseVector x = {{2, 4, 9}, {-10.0, 6.0, -9.0}};  // 3 of the first less 2 of the second
  const auto parts = span.parts_of(x);
  ASSERT_TRUE(parts.has_value());
  EXPECT_EQ(parts->size(), 2u);
  const auto sum = sum_of(*parts, vectors);
  for (int k = 0; k < x.size(); ++k) EXPECT_NEAR(sum.at(x.rows[k]), x.values[k], 1e-14);
  EXPECT_FALSE(span.parts_of({{2, 4, 9}, {-10.0, 6.0, -9.0 + 1e-9}}).has_value());
  EXPECT_FALSE(span.parts_of({{4}, {1.0}}).has_value());
  EXPECT_FALSE(span.parts_of({{5}, {1.0}}).has_value());  // nothing acts there
  span.clear();
  EXPECT_FALSE(span.parts_of(vectors[2]).has_value());
}

/// A vector that others make up is not one of the parts, whatever is added behind it.
TEST(VectorSpan, LeavesOutWhatItHasAlready) {
  VectorSpan span;
  span.add({{0, 1}, {1.0, 1.0}}, 0);
  span.add({{0, 1}, {2.0, 2.0}}, 1);
  span.add({{1, 2}, {1.0, 1.0}}, 2);
  const auto parts = span.parts_of({{0, 1}, {3.0, 3.0}});
  ASSERT_TRUE(parts.has_value());
  ASSERT_EQ(parts->size(), 1u);
  EXPECT_EQ(parts->front().number, 0);
  EXPECT_NEAR(parts->front().share, 3.0, 1e-14);
}

/// Their errors would be those of vectors a hundred times as long.
TEST(VectorSpan, DoesNotTakeTheDifferenceOfVectorsThatAreAlmostTheSame) {
  VectorSpan span;
  span.add({{0, 1}, {1.0, 0.0}}, 0);
  span.add({{0, 1}, {1.0, 0.01}}, 1);
  EXPECT_FALSE(span.parts_of({{1}, {1.0}}).has_value());
  EXPECT_TRUE(span.parts_of({{0, 1}, {1.0, 0.005}}).has_value());
}

}  // namespace
}  // namespace perilink
