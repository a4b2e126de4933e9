#include "app/report/report_streams.hpp"

#include <algorithm>
#include <cmath>

#include "io/fields/compressed_text.hpp"

namespace perilink {
namespace {

template <class Number>
void append_raw(std::string& bytes, std::span<const Number> numbers) {
  bytes.append(reinterpret_cast<const char*>(numbers.data()), numbers.size_bytes());
}

}  // namespace

std::size_t ReportStreams::add(std::string_view bytes) {
  texts_.push_back(compress_to_base64(bytes));
  return texts_.size() - 1;
}

void append_steps(std::string& bytes, std::span<const float> numbers, float low, float high) {
  const std::size_t begin = bytes.size();
  bytes.resize(begin + 2 * numbers.size());
  const double scale = high > low ? largest_step / (static_cast<double>(high) - low) : 0.0;
  int before = 0;
  for (std::size_t k = 0; k < numbers.size(); ++k) {
    const double place = scale * (static_cast<double>(numbers[k]) - low);
    const int step = static_cast<int>(std::lround(std::clamp(place, 0.0, 1.0 * largest_step)));
    const int difference = step - before;
    const int folded = difference < 0 ? -2 * difference - 1 : 2 * difference;
    bytes[begin + k] = static_cast<char>(folded & 255);
    bytes[begin + numbers.size() + k] = static_cast<char>(folded >> 8);
    before = step;
  }
}

void append_numbers(std::string& bytes, std::span<const float> numbers) {
  append_raw(bytes, numbers);
}

void append_numbers(std::string& bytes, std::span<const std::int32_t> numbers) {
  append_raw(bytes, numbers);
}

}  // namespace perilink
