#pragma once

#include <string>
#include <type_traits>
#include <vector>

#include "base/error.hpp"
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

/// Sets a key of a table of a case's document and removes the keys that it replaces: `spacing`
/// replaces `columns`, `horizon_ratio` replaces `horizon` and `horizon_level`.
/// \param where  of the table, for messages
/// \throws InputError  where --set has given a key that is replaced
void set_key(TomlValue& table, TomlValue key, const SourceLocation& where);

/// Sets keys in [body] of a case's document. `method = "linear_elements"` removes all keys of
/// bonds.
/// \throws InputError  where --set has given a key that is replaced
void override_body(TomlValue& document, const std::string& path,
                   const std::vector<TomlValue>& keys);

}  // namespace perilink
