#pragma once

#ifdef PERILINK_RARE_BRANCHES
#include <cstdint>
#include <cstdlib>
#endif

/// \file
/// Test builds that take rare branches on purpose (docs/developers/testing.md).

namespace perilink {

#ifdef PERILINK_RARE_BRANCHES
/// Draws whether to take a rare branch, one time in four. The environment variable
/// PERILINK_RARE_SEED, a number, determines all draws of a thread; without it or with 0 no branch
/// is taken.
/// \param where  name of the branch
inline bool take_rare_branch(const char* where) {
  static const char* const text = std::getenv("PERILINK_RARE_SEED");
  static const std::uint64_t seed = text != nullptr ? std::strtoull(text, nullptr, 10) : 0;
  thread_local std::uint64_t draws = 0;
  if (seed == 0) return false;
  std::uint64_t mixed = seed * 0x9e3779b97f4a7c15 + ++draws;
  for (const char* c = where; *c != '\0'; ++c) {
    mixed = (mixed ^ static_cast<unsigned char>(*c)) * 0x100000001b3;
  }
  mixed = (mixed ^ (mixed >> 30)) * 0xbf58476d1ce4e5b9;
  mixed = (mixed ^ (mixed >> 27)) * 0x94d049bb133111eb;
  return ((mixed ^ (mixed >> 31)) & 3) == 0;
}
#else
/// Returns false: only test builds take rare branches on purpose.
constexpr bool take_rare_branch(const char* /*where*/) { return false; }
#endif

}  // namespace perilink
