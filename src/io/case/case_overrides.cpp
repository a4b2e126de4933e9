#include "io/case/case_overrides.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

#include "io/case/case_keys.hpp"

namespace perilink {
namespace {

/// Keys of one table, each of which says what the others say.
constexpr std::array alternatives = {
    std::array{"spacing", "columns", ""},  std::array{"horizon", "horizon_level", "horizon_ratio"},
    std::array{"region", "regions", ""},   std::array{"to", "to_load", ""},
    std::array{"force", "body_force", ""}, std::array{"traction", "pressure", ""},
    std::array{"stiffness", "total", ""},  std::array{"spacings", "size", ""},
};

/// Whether a key takes the place of another in its table.
bool replaces(const TomlValue& key, const std::string& other) {
  if (key.key == other) return true;
  const auto holds = [](const auto& group, const std::string& name) {
    return std::find(group.begin(), group.end(), name) != group.end();
  };
  return std::any_of(alternatives.begin(), alternatives.end(), [&](const auto& group) {
    return holds(group, key.key) && holds(group, other);
  });
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

void set_key(TomlValue& table, TomlValue key, const SourceLocation& where) {
  for (const TomlValue& entry : table.entries) {
    if (entry.line != from_option || !replaces(key, entry.key)) continue;
    const bool of_study = key.line != from_option;
    throw InputError(
        {where.file, from_option, where.key.empty() ? entry.key : where.key + "." + entry.key},
        of_study               ? "is given, but the study varies it"
        : entry.key == key.key ? "is given twice"
                               : fmt::format("is given together with `{}`", key.key),
        of_study ? "change [vary] of the study, or leave the option out" : "give it once");
  }
  std::erase_if(table.entries, [&](const TomlValue& entry) { return replaces(key, entry.key); });
  table.entries.push_back(std::move(key));
}

void override_body(TomlValue& document, const std::string& path,
                   const std::vector<TomlValue>& keys) {
  TomlValue* body = document.find("body");
  // A document without the table is refused by the reader of cases.
  if (body == nullptr || body->kind != TomlValue::Kind::table) return;
  for (const TomlValue& key : keys) {
    if (key.text == word_of(BodyMethod::linear_elements)) {
      const std::vector<std::string_view> of_bonds = keys_of_bonds();
      std::erase_if(body->entries, [&](const TomlValue& entry) {
        return std::find(of_bonds.begin(), of_bonds.end(), entry.key) != of_bonds.end();
      });
    }
    set_key(*body, key, {path, 0, "body"});
  }
}

}  // namespace perilink
