#include "io/case/case_overrides.hpp"

#include <algorithm>
#include <string_view>

#include "io/case/case_keys.hpp"

namespace perilink {
namespace {

/// Returns the other keys of [body] that a key replaces.
std::vector<std::string_view> replaced_by(const TomlValue& key) {
  if (key.key == "spacing") return {"columns"};
  if (key.key == "columns") return {"spacing"};
  if (key.key == "horizon_ratio") return {"horizon", "horizon_level"};
  if (key.text == word_of(BodyMethod::linear_elements)) return keys_of_bonds();
  return {};
}

}  // namespace

TomlValue body_key(const std::string& key, double value) {
  TomlValue result;
  result.kind = TomlValue::Kind::number;
  result.key = key;
  result.number = value;
  return result;
}

TomlValue body_key(const std::string& key, int value) {
  TomlValue result = body_key(key, static_cast<double>(value));
  result.kind = TomlValue::Kind::integer;
  result.integer = value;
  return result;
}

TomlValue body_key(const std::string& key, const std::string& value) {
  TomlValue result;
  result.kind = TomlValue::Kind::text;
  result.key = key;
  result.text = value;
  return result;
}

void override_body(TomlValue& document, const std::vector<TomlValue>& keys) {
  const auto body = std::find_if(document.entries.begin(), document.entries.end(),
                                 [](const TomlValue& entry) { return entry.key == "body"; });
  // A document without the table is refused by the reader of cases.
  if (body == document.entries.end() || body->kind != TomlValue::Kind::table) return;
  for (const TomlValue& key : keys) {
    std::vector<std::string_view> replaced = replaced_by(key);
    replaced.push_back(key.key);
    std::erase_if(body->entries, [&](const TomlValue& entry) {
      return std::find(replaced.begin(), replaced.end(), entry.key) != replaced.end();
    });
    body->entries.push_back(key);
  }
}

}  // namespace perilink
