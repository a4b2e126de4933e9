#pragma once

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
