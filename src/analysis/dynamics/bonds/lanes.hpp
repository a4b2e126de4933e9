#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>

#include "base/lanes.hpp"

/// \file
/// Vector registers: values of consecutive particles, one register full and eight at most.

namespace perilink {

constexpr int num_lanes = lanes_of<double>(8);
using Doubles = Lanes<double, num_lanes>;
using Words = Lanes<std::int64_t, num_lanes>;
using AllLanes = std::make_index_sequence<num_lanes>;

inline void load(const double* from, Doubles& to) {
  to = *reinterpret_cast<const LanesInMemory<double, num_lanes>*>(from);
}

/// Returns 1, 2, 4 and so on, one bit per lane.
template <std::size_t... Lane>
constexpr Words bits_of_lanes(std::index_sequence<Lane...> /*lanes*/) {
  return Words{(std::int64_t{1} << Lane)...};
}

/// Sets lanes whose bit is not set to zero.
inline void keep_lanes(std::uint8_t bits, Doubles& values) {
  constexpr Words bit = bits_of_lanes(AllLanes{});
  const Words kept = (Words{} + std::int64_t{bits}) & bit;
  values = kept != 0 ? values : Doubles{};
}

inline void keep_larger(const Doubles& values, Doubles& largest) {
  largest = values > largest ? values : largest;
}

/// Returns one component of vectors of `Dim` stored consecutively in a, b and, in space, c.
template <int Dim, int Component, std::size_t... Lane>
inline Doubles component(const Doubles& a, const Doubles& b, const Doubles& c,
                         std::index_sequence<Lane...> /*lanes*/) {
  constexpr std::size_t two = 2 * num_lanes;
  constexpr auto at = [](std::size_t lane) { return Dim * lane + Component; };
  const Doubles of_two = __builtin_shufflevector(a, b, (at(Lane) < two ? at(Lane) : 0)...);
  if constexpr (Dim == 2) return of_two;
  return __builtin_shufflevector(of_two, c, (at(Lane) < two ? Lane : at(Lane) - num_lanes)...);
}

/// Loads `num_lanes` vectors of `Dim` components that lie one after the other in memory.
/// \param to  one register per component, size Dim
template <int Dim>
inline void load_vectors(const double* from, Doubles* to) {
  static_assert(1 <= Dim && Dim <= 3);
  if constexpr (Dim == 1) {
    load(from, to[0]);
    return;
  }
  Doubles a, b, c{};
  load(from, a);
  load(from + num_lanes, b);
  if constexpr (Dim == 3) load(from + 2 * num_lanes, c);
  to[0] = component<Dim, 0>(a, b, c, AllLanes{});
  to[1] = component<Dim, 1>(a, b, c, AllLanes{});
  if constexpr (Dim == 3) to[2] = component<Dim, 2>(a, b, c, AllLanes{});
}

}  // namespace perilink
