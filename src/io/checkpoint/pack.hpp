#pragma once

#include <cereal/archives/binary.hpp>
#include <cereal/types/array.hpp>
#include <cereal/types/map.hpp>
#include <cereal/types/optional.hpp>
#include <cereal/types/string.hpp>
#include <cereal/types/utility.hpp>
#include <cereal/types/vector.hpp>
#include <sstream>
#include <string>

#include "base/error.hpp"

namespace perilink {

/// Returns the bytes of values: numbers, texts, lists of them, and types with a member function
/// `template <class Archive> void serialize(Archive& archive)` that names all its data.
template <class... Values>
std::string pack(const Values&... values) {
  std::ostringstream stream;
  cereal::BinaryOutputArchive archive(stream);
  archive(values...);
  return stream.str();
}

/// Restores values from the bytes of pack() of the same types. \throws FileError
template <class... Values>
void unpack(const std::string& bytes, Values&... values) {
  std::istringstream stream(bytes);
  try {
    cereal::BinaryInputArchive archive(stream);
    archive(values...);
  } catch (const cereal::Exception&) {
    throw FileError("the saved state is incomplete");
  }
}

}  // namespace perilink
