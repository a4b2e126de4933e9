#include "app/report/report_streams.hpp"

#include <gtest/gtest.h>

#include <cstring>

#include "support/decompressed.hpp"

namespace perilink {
namespace {

/// Reads steps back as the script of a report does.
std::vector<double> numbers_of(const std::string& bytes, std::size_t count, double low,
                               double high) {
  std::vector<double> numbers;
  int step = 0;
  for (std::size_t k = 0; k < count; ++k) {
    const int folded =
        static_cast<unsigned char>(bytes[k]) | static_cast<unsigned char>(bytes[count + k]) << 8;
    step += folded % 2 == 1 ? -(folded + 1) / 2 : folded / 2;
    numbers.push_back(low + step * (high - low) / largest_step);
  }
  return numbers;
}

TEST(ReportStreams, StepsComeBackWithinHalfAStep) {
  const std::vector<float> values = {-2.0F, 6.0F, -2.0F, 0.123F, 5.999F, 1.0F};
  std::string bytes;
  append_steps(bytes, values, -2.0F, 6.0F);
  ASSERT_EQ(bytes.size(), 2 * values.size());
  const auto back = numbers_of(bytes, values.size(), -2.0, 6.0);
  for (std::size_t k = 0; k < values.size(); ++k) {
    EXPECT_NEAR(back[k], values[k], 0.5 * 8.0 / largest_step + 1e-6) << k;  // and single precision
  }
}

TEST(ReportStreams, NumbersOutsideTheRangeAreItsEnds) {
  std::string bytes;
  append_steps(bytes, std::vector<float>{-9.0F, 9.0F}, 0.0F, 1.0F);
  EXPECT_EQ(numbers_of(bytes, 2, 0.0, 1.0), (std::vector<double>{0.0, 1.0}));
}

TEST(ReportStreams, ARangeOfOneNumberHasOneStep) {
  std::string bytes;
  append_steps(bytes, std::vector<float>{3.0F, 3.0F}, 3.0F, 3.0F);
  EXPECT_EQ(bytes, std::string(4, '\0'));
}

TEST(ReportStreams, AreNumberedAndCompressed) {
  ReportStreams streams;
  EXPECT_EQ(streams.add("rows"), 0u);
  EXPECT_EQ(streams.add("fields"), 1u);
  EXPECT_EQ(test::decompressed(streams.texts().at(1)), "fields");
}

TEST(ReportStreams, NumbersAreLittleEndian) {
  std::string bytes;
  append_numbers(bytes, std::vector<std::int32_t>{1, -1});
  EXPECT_EQ(bytes, std::string("\1\0\0\0\xff\xff\xff\xff", 8));
  append_numbers(bytes, std::vector<float>{0.5F});
  float half = 0.0F;
  std::memcpy(&half, bytes.data() + 8, 4);
  EXPECT_EQ(half, 0.5F);
}

}  // namespace
}  // namespace perilink
