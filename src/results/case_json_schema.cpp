#include "results/case_json_schema.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <vector>

#include "io/case/case_keys.hpp"
#include "io/case/case_page.hpp"
#include "io/text/toml_tree.hpp"

namespace perilink {
namespace {

using Json = nlohmann::ordered_json;
using Kind = Values::Kind;

Json list_of(const Json& items, int least = 0, int most = 0) {
  Json list = {{"type", "array"}, {"items", items}};
  if (least > 0) list["minItems"] = least;
  if (most > 0) list["maxItems"] = most;
  return list;
}

Json number_in(const Range& range, bool whole) {
  Json number = {{"type", whole ? "integer" : "number"}};
  const auto shown = [&](double limit) { return whole ? Json(std::llround(limit)) : Json(limit); };
  if (std::isfinite(range.least)) {
    number[range.above ? "exclusiveMinimum" : "minimum"] = shown(range.least);
  }
  if (std::isfinite(range.most)) {
    number[range.below ? "exclusiveMaximum" : "maximum"] = shown(range.most);
  }
  return number;
}

Json words_in(const std::vector<std::string_view>& words) {
  Json text = {{"type", "string"}};
  for (const std::string_view word : words) text["enum"].push_back(std::string(word));
  return text;
}

Json values_of(const Values& values) {
  const Json number = number_in(values.range, false);
  const Json formula = {{"type", {"number", "string"}}};
  switch (values.kind) {
    case Kind::boolean: return {{"type", "boolean"}};
    case Kind::integer: return number_in(values.range, true);
    case Kind::number: return number;
    case Kind::energy: return {{"anyOf", {number, words_in({"infinite"})}}};
    case Kind::text: return words_in(values.words);
    case Kind::axis:
    case Kind::normal: return words_in({"x", "y", "z"});
    case Kind::components:
    case Kind::position: return list_of(number, 2, 3);
    case Kind::points: return list_of(list_of(number, 2, 3));
    case Kind::pairs: return list_of(list_of(number, 2, 2));
    case Kind::formula: return formula;
    case Kind::formulas: return list_of(formula, 2, 3);
    case Kind::moment: return {{"anyOf", {number, list_of(number, 3, 3)}}};
    case Kind::by_type: break;
  }
  return Json::object();
}

Json json_of(const TomlValue& value) {
  switch (value.kind) {
    case TomlValue::Kind::boolean: return value.boolean;
    case TomlValue::Kind::integer: return value.integer;
    case TomlValue::Kind::number: return value.number;
    case TomlValue::Kind::text: return value.text;
    default: break;
  }
  Json list = Json::array();
  for (const TomlValue& item : value.items) list.push_back(json_of(item));
  return list;
}

std::string description_of(const TableSchema& table, const KeySchema& key) {
  const PageRow row = page_row(table.name, key.name);
  return fmt::format("{}. Values: {}{}{}.", row.meaning, row.values,
                     row.fallback.empty() ? "" : ". Default: ", row.fallback);
}

Json schema_of(const TableSchema& table, const KeySchema& key) {
  Json schema = key.values.list ? list_of(values_of(key.values)) : values_of(key.values);
  if (const auto fallback = default_of(key)) schema["default"] = json_of(*fallback);
  schema["description"] = description_of(table, key);
  return schema;
}

/// Whether a table of any kind of case has the key.
bool is_needed(const KeySchema& key) {
  return !key.missing.empty() && key.not_for.empty() && key.choice.empty() && key.companion.empty();
}

void add_keys(const TableSchema& table, Json& object) {
  object["additionalProperties"] = false;
  for (const KeySchema& key : table.keys) {
    object["properties"][std::string(key.name)] = schema_of(table, key);
    if (is_needed(key)) object["required"].push_back(std::string(key.name));
  }
  if (!table.list) return;
  for (const auto& group : table.one_of) {
    Json choices = Json::array();
    for (const std::string_view name : group)
      choices.push_back({{"required", {std::string(name)}}});
    object["oneOf"] = choices;
  }
}

}  // namespace

std::optional<TomlValue> default_of(const KeySchema& key) {
  const std::string line = key.fallback && key.missing.empty() ? key.fallback(key) : "";
  if (line.empty()) return std::nullopt;
  TomlValue value = parse_toml(line, "").entries.at(0);
  const bool number =
      value.kind == TomlValue::Kind::number || value.kind == TomlValue::Kind::integer;
  if (number && !key.values.range.contains(value.number)) return std::nullopt;
  return value;
}

std::vector<std::string> settable_keys() {
  std::vector<std::string> names;
  for (const TableSchema& table : case_schema()) {
    const std::string above = table.name.empty() ? ""
                              : table.list       ? fmt::format("{}[1].", table.name)
                                                 : fmt::format("{}.", table.name);
    for (const KeySchema& key : table.keys) names.push_back(above + std::string(key.name));
  }
  return names;
}

std::string case_json_schema() {
  Json schema = {{"$schema", "http://json-schema.org/draft-07/schema#"},
                 {"title", "Case file of Perilink"},
                 {"type", "object"}};
  add_keys(case_schema().front(), schema);
  for (const TableSchema& table : case_schema()) {
    if (table.name.empty()) continue;
    Json keys = {{"type", "object"}};
    add_keys(table, keys);
    schema["properties"][std::string(table.name)] = table.list ? list_of(keys) : keys;
  }
  schema["required"] = {"body", "regions", "materials"};
  return schema.dump(2) + "\n";
}

std::string case_reference() {
  std::string text;
  for (const TableSchema& table : case_schema()) {
    if (!table.name.empty()) text += "\n" + header_of(table) + "\n";
    for (const KeySchema& key : table.keys) {
      text += fmt::format("  {}: {}\n", key.name, description_of(table, key));
    }
  }
  return text;
}

}  // namespace perilink
