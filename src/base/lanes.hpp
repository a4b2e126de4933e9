#pragma once

#include <algorithm>
#include <cstddef>

#ifdef __AVX__
#include <immintrin.h>
#endif

namespace perilink {

/// Numbers side by side in one register.
template <class Number, std::size_t Count>
using Lanes [[gnu::vector_size(sizeof(Number) * Count)]] = Number;

/// The same in memory, wherever they begin.
template <class Number, std::size_t Count>
using LanesInMemory
    [[gnu::vector_size(sizeof(Number) * Count), gnu::aligned(sizeof(Number)), gnu::may_alias]] =
        Number;

/// Bytes of the widest registers that this file is compiled for.
#if defined(__AVX512F__)
constexpr std::size_t register_bytes = 64;
#elif defined(__AVX__)
constexpr std::size_t register_bytes = 32;
#else
constexpr std::size_t register_bytes = 16;
#endif

/// Numbers of a row of so many that one register holds. Never called: files differ in it.
template <class Number>
consteval std::size_t lanes_of(std::size_t count) {
  return std::min(count, register_bytes / sizeof(Number));
}

/// A row of numbers in as many registers as it takes, or in memory, wherever it begins. GCC takes
/// vectors that are longer than a register through memory, number by number.
template <class Number, std::size_t Count, std::size_t InRegister = lanes_of<Number>(Count)>
struct [[gnu::may_alias]] LongLanes {
  static constexpr std::size_t count = Count / InRegister;
  LanesInMemory<Number, InRegister> parts[count];

  // As a whole it would be copied in pieces that are shorter than registers.
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

/// Four numbers in double precision. GCC 12 takes __builtin_convertvector apart into halves.
inline Lanes<double, 4> widen(const float* numbers) {
#ifdef __AVX__
  return _mm256_cvtps_pd(_mm_loadu_ps(numbers));
#else
  const Lanes<float, 4> read = *reinterpret_cast<const LanesInMemory<float, 4>*>(numbers);
  return __builtin_convertvector(read, Lanes<double, 4>);
#endif
}

/// (0 + 2) + (1 + 3).
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
