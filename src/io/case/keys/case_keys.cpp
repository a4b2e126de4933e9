#include "io/case/case_keys.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>

#include "io/case/keys/key_tables.hpp"

namespace perilink {

const std::vector<TableSchema>& case_schema() {
  static const std::vector<TableSchema> schema = {
      top_table(),      body_table(),         region_table(),   material_table(),
      support_table(),  displacement_table(), velocity_table(), load_table(),
      traction_table(), point_load_table(),   symmetry_table(), spring_table(),
      crack_table(),    interface_table(),    random_table(),   graded_table(),
      rebar_table(),    element_table(),      gauge_table(),    analysis_table(),
      stop_table(),     stage_table(),        output_table()};
  return schema;
}

const TableSchema& table_schema(std::string_view name) {
  const auto found = std::ranges::find(case_schema(), name, &TableSchema::name);
  if (found == case_schema().end()) throw std::logic_error("no table " + std::string(name));
  return *found;
}

namespace shared {

std::vector<KeySchema> joined_keys(std::initializer_list<std::vector<KeySchema>> lists) {
  std::vector<KeySchema> keys;
  for (const auto& list : lists) keys.insert(keys.end(), list.begin(), list.end());
  return keys;
}

std::vector<KeySchema> softening_keys(const Without& without, const Without& knees) {
  return {KeySchema("softening_error", {Kind::number, Range{1e-5, 1.0, false, true}}, without)
              .hinted("give 1e-5 to below 1: a smaller error needs too many saw-tooth segments"),
          {"softening_points", Kind::pairs, without},
          {"softening_stretches", positive_number.as_list(), without},
          {"closing", Kind::boolean, without},
          {"knee_stress_ratio", {Kind::number, fraction}, knees},
          {"knee_opening_ratio", {Kind::number, fraction}, knees}};
}

}  // namespace shared

std::vector<std::string_view> keys_of_bonds() {
  std::vector<std::string_view> keys;
  for (const KeySchema& key : table_schema("body").keys) {
    if (!key.not_for.empty() && key.not_for.front().fault == shared::no_bonds) {
      keys.push_back(key.name);
    }
  }
  return keys;
}

}  // namespace perilink
