#pragma once

#include <string>
#include <type_traits>
#include <vector>

#include "io/case/case_words.hpp"
#include "io/text/toml_tree.hpp"

namespace perilink {

/// A key for override_body. It has no line, for no line of the case holds it.
TomlValue body_key(const std::string& key, double value);
TomlValue body_key(const std::string& key, int value);
TomlValue body_key(const std::string& key, const std::string& value);
template <class Enumeration>
requires std::is_enum_v<Enumeration> TomlValue body_key(const std::string& key, Enumeration value) {
  return body_key(key, std::string(word_of(value)));
}

/// Puts keys into [body] of a case's document, in place of those of the same name and of those that
/// say the same otherwise: `spacing` takes the place of `columns` too, `horizon_ratio` that of
/// `horizon` and `horizon_level`, and `method = "linear_elements"` that of all keys of bonds.
void override_body(TomlValue& document, const std::vector<TomlValue>& keys);

}  // namespace perilink
