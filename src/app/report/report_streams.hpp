#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace perilink {

/// Compressed data of a report, named by their numbers.
class ReportStreams {
 public:
  /// Compresses bytes and returns the number of the stream.
  std::size_t add(std::string_view bytes);

  /// Returns the streams in base64 (compress_to_base64).
  const std::vector<std::string>& texts() const { return texts_; }

 private:
  std::vector<std::string> texts_;
};

/// Largest step of append_steps(): a range has 2^14 - 1 steps.
inline constexpr int largest_step = 16383;

/// Appends numbers as steps of a range from `low` to `high`: per number the difference to the step
/// before it, as 2|d| or 2|d| - 1 if it is negative, first the low bytes of all numbers, then the
/// high bytes. Numbers outside the range count as its ends. Neighbours have similar numbers, so
/// that the bytes compress to a third.
void append_steps(std::string& bytes, std::span<const float> numbers, float low, float high);

/// Appends numbers of 32 bits, little-endian.
void append_numbers(std::string& bytes, std::span<const float> numbers);
void append_numbers(std::string& bytes, std::span<const std::int32_t> numbers);

}  // namespace perilink
