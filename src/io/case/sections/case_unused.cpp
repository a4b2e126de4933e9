#include "io/case/sections/case_unused.hpp"

#include <fmt/format.h>

#include "base/plain_text.hpp"
#include "io/case/case_keys.hpp"
#include "io/case/sections/case_kinds.hpp"

namespace perilink {
namespace {

std::string filled_in(std::string_view text, const CaseFile& kind) {
  return fmt::format(fmt::runtime(text), fmt::arg("model", word_of(kind.body.model)),
                     fmt::arg("type", word_of(kind.analysis.type)),
                     fmt::arg("resting", why_nothing_rotates(kind.body)),
                     fmt::arg("turning", what_rotates(kind.body)));
}

}  // namespace

std::vector<std::string> find_unused(const TomlValue& document, const CaseFile& kind) {
  std::vector<std::string> unused;
  const auto look = [&](const std::vector<NotFor>& column, const std::string& key) {
    const NotFor* found = exception_of(column, kinds_of(kind));
    if (found == nullptr) return;
    if (found->fault.empty()) return unused.push_back(key);
    throw InputError(kind.where(found->about.empty() ? key : std::string(found->about)),
                     filled_in(found->fault, kind), filled_in(found->suggestion, kind));
  };
  const auto look_into = [&](const TableSchema& schema, const TomlValue& table,
                             const std::string& path) {
    for (const KeySchema& key : schema.keys) {
      const std::string name(key.name);
      if (table.find(name) != nullptr) look(key.not_for, path + "." + name);
    }
  };
  for (const TableSchema& schema : case_schema()) {
    const std::string name(schema.name);
    const TomlValue* table = document.find(name);
    if (table == nullptr || (schema.list && table->items.empty())) continue;
    look(schema.not_for, schema.list ? item_key(name, 0) : name);
    look_into(schema, *table, name);
    for (std::size_t i = 0; i < table->items.size(); ++i) {
      look_into(schema, table->items[i], item_key(name, i));
    }
  }
  return unused;
}

std::optional<std::string> note_of_unused(const CaseFile& input) {
  if (input.source.unused.empty()) return std::nullopt;
  return fmt::format("not used by type = \"{}\": {}", word_of(input.analysis.type),
                     joined(input.source.unused));
}

}  // namespace perilink
