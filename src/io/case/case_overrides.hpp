#pragma once

#include <string>
#include <type_traits>
#include <vector>

#include "io/case/case_words.hpp"
#include "io/text/toml_tree.hpp"

namespace perilink {

/// Returns a key for override_body, without a line of the case file.
TomlValue body_key(const std::string& key, double value);
TomlValue body_key(const std::string& key, int value);
TomlValue body_key(const std::string& key, const std::string& value);
template <class Enumeration>
requires std::is_enum_v<Enumeration> TomlValue body_key(const std::string& key, Enumeration value) {
  return body_key(key, std::string(word_of(value)));
}

/// Sets keys in [body] of a case's document and removes the keys that they replace. `spacing` also
/// replaces `columns`, `horizon_ratio` also replaces `horizon` and `horizon_level`, and `method =
/// "linear_elements"` replaces all keys of bonds.
void override_body(TomlValue& document, const std::vector<TomlValue>& keys);

}  // namespace perilink
