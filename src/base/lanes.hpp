#pragma once

#include <algorithm>
#include <cstddef>

#ifdef __AVX__
#include <immintrin.h>
#endif

namespace perilink {

/// Vector of numbers in one register.
template <class Number, std::size_t Count>
using Lanes [[gnu::vector_size(sizeof(Number) * Count)]] = Number;

/// Vector of numbers in memory, without alignment.
template <class Number, std::size_t Count>
using LanesInMemory
    [[gnu::vector_size(sizeof(Number) * Count), gnu::aligned(sizeof(Number)), gnu::may_alias]] =
        Number;

/// Bytes of the widest registers in this compilation.
#if defined(__AVX512F__)
constexpr std::size_t register_bytes = 64;
#elif defined(__AVX__)
constexpr std::size_t register_bytes = 32;
#else
constexpr std::size_t register_bytes = 16;
#endif

/// Returns how many of `count` numbers one register holds. Files are compiled for different
/// registers, so this function must only be evaluated at compile time.
template <class Number>
consteval std::size_t lanes_of(std::size_t count) {
  return std::min(count, register_bytes / sizeof(Number));
}

/// Row of numbers in several registers, or in memory without alignment. GCC would pass vectors
/// longer than a register through memory, one number at a time.
template <class Number, std::size_t Count, std::size_t InRegister = lanes_of<Number>(Count)>
struct [[gnu::may_alias]] LongLanes {
  static constexpr std::size_t count = Count / InRegister;
  LanesInMemory<Number, InRegister> parts[count];

  // The default copy would use pieces shorter than registers.
  LongLanes() = default;
  LongLanes(const LongLanes& other) { *this = other; }
  LongLanes& operator=(const LongLanes& other) {
    for (std::size_t k = 0; k < count; ++k) parts[k] = other.parts[k];
    return *this;
  }
  LongLanes& operator+=(const LongLanes& other) {
    for (std::size_t k = 0; k < count; ++k) parts[k] += other.parts[k];
    return *this;
  }
  LongLanes& operator-=(const LongLanes& other) {
    for (std::size_t k = 0; k < count; ++k) parts[k] -= other.parts[k];
    return *this;
  }
  LongLanes& operator*=(Number factor) {
    for (std::size_t k = 0; k < count; ++k) parts[k] *= factor;
    return *this;
  }
  friend LongLanes operator-(LongLanes a, const LongLanes& b) { return a -= b; }
  friend LongLanes operator*(Number factor, LongLanes a) { return a *= factor; }
  Number operator[](std::size_t k) const { return parts[k / InRegister][k % InRegister]; }
};

/// Converts four numbers to double precision. GCC 12 splits __builtin_convertvector into halves.
inline Lanes<double, 4> widen(const float* numbers) {
#ifdef __AVX__
  return _mm256_cvtps_pd(_mm_loadu_ps(numbers));
#else
  const Lanes<float, 4> read = *reinterpret_cast<const LanesInMemory<float, 4>*>(numbers);
  return __builtin_convertvector(read, Lanes<double, 4>);
#endif
}

/// Returns the sum in the order (0 + 2) + (1 + 3).
inline double add_up(Lanes<double, 4> numbers) {
#ifdef __AVX__
  const __m128d pairs =
      _mm_add_pd(_mm256_castpd256_pd128(numbers), _mm256_extractf128_pd(numbers, 1));
  return _mm_cvtsd_f64(_mm_add_sd(pairs, _mm_unpackhi_pd(pairs, pairs)));
#else
  return (numbers[0] + numbers[2]) + (numbers[1] + numbers[3]);
#endif
}

}  // namespace perilink
