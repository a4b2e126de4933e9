#include "app/report/report_rows.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace perilink {
namespace {

TEST(ReportRows, FewAreAllShown) {
  EXPECT_EQ(shown_rows({5.0, 1.0, 3.0}, 3), (std::vector<std::size_t>{0, 1, 2}));
  EXPECT_TRUE(shown_rows({}, 3).empty());
}

TEST(ReportRows, OfManyTheEnvelopeStays) {
  // A zigzag with one peak and one dip in unlikely places.
  std::vector<double> loads(1000);
  for (std::size_t k = 0; k < loads.size(); ++k) loads[k] = k % 2 == 0 ? 1.0 : -1.0;
  loads[377] = 9.0;
  loads[641] = -9.0;
  const std::vector<std::size_t> rows = shown_rows(loads, 40);
  EXPECT_LE(rows.size(), 40u);
  EXPECT_TRUE(std::ranges::is_sorted(rows));
  for (const std::size_t row :
       {std::size_t{0}, std::size_t{377}, std::size_t{641}, std::size_t{999}}) {
    EXPECT_TRUE(std::ranges::binary_search(rows, row)) << row;
  }
}

TEST(ReportRows, TextIsThatOfTheFile) {
  const std::string text = "a,b\n1,0.1\n2,1e-7\n3,5\n4,cut";
  EXPECT_EQ(text_of_rows(text, {0, 2}), "a,b\n1,0.1\n3,5\n");
  EXPECT_EQ(text_of_rows(text, {0, 1, 2}), "a,b\n1,0.1\n2,1e-7\n3,5\n");
  EXPECT_EQ(text_of_rows(text, {2, 3, 9}), "a,b\n3,5\n") << "no line without its end";
}

}  // namespace
}  // namespace perilink
