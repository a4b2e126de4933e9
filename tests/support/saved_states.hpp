#pragma once

#include <cereal/archives/binary.hpp>
#include <cereal/types/string.hpp>
#include <cereal/types/vector.hpp>

#include <sstream>
#include <string>

#include "analysis/dynamics/time_state.hpp"

/// \file
/// States of runs over time as bytes.

namespace perilink::test {

template <class Value>
std::string bytes_of(const Value& value) {
  std::ostringstream out;
  cereal::BinaryOutputArchive archive(out);
  archive(value);
  return out.str();
}

inline TimeState state_of(const std::string& bytes) {
  std::istringstream in(bytes);
  cereal::BinaryInputArchive archive(in);
  TimeState state;
  archive(state);
  return state;
}

}  // namespace perilink::test
