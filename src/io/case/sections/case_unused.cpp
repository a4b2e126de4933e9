#include "io/case/sections/case_unused.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "io/case/case_keys.hpp"
#include "io/case/sections/case_kinds.hpp"

namespace perilink {
namespace {

class Search {
 public:
  explicit Search(const CaseFile& input) : input_(input), kind_(kinds_of(input)) {}

  /// \param key  path of what the column belongs to
  void look(const std::vector<NotFor>& column, const std::string& key) {
    const auto found = std::find_if(column.begin(), column.end(),
                                    [&](const NotFor& entry) { return entry.holds(kind_); });
    if (found == column.end()) return;
    if (found->fault.empty()) {
      unused.push_back(key);
      return;
    }
    const auto filled = [&](std::string_view text) {
      return fmt::format(fmt::runtime(text), fmt::arg("model", word_of(input_.body.model)),
                         fmt::arg("type", word_of(input_.analysis.type)),
                         fmt::arg("resting", why_nothing_rotates(input_.body)),
                         fmt::arg("turning", what_rotates(input_.body)));
    };
    throw InputError(input_.where(found->about.empty() ? key : std::string(found->about)),
                     filled(found->fault), filled(found->suggestion));
  }

  void look(const TableSchema& schema, const TomlValue& table, const std::string& path) {
    for (const KeySchema& key : schema.keys) {
      const std::string name(key.name);
      if (table.find(name) != nullptr) look(key.not_for, path + "." + name);
    }
  }

  std::vector<std::string> unused;

 private:
  const CaseFile& input_;
  const Kinds kind_;
};

}  // namespace

std::vector<std::string> find_unused(const TomlValue& document, const CaseFile& kind) {
  Search search(kind);
  for (const TableSchema& schema : case_schema()) {
    const std::string name(schema.name);
    const TomlValue* table = document.find(name);
    if (table == nullptr || (schema.list && table->items.empty())) continue;
    search.look(schema.not_for, schema.list ? item_key(name, 0) : name);
    if (!schema.list) search.look(schema, *table, name);
    for (std::size_t i = 0; i < table->items.size(); ++i) {
      search.look(schema, table->items[i], item_key(name, i));
    }
  }
  return std::move(search.unused);
}

std::optional<std::string> note_of_unused(const CaseFile& input) {
  if (input.unused.empty()) return std::nullopt;
  return fmt::format("not used by type = \"{}\": {}", word_of(input.analysis.type),
                     fmt::join(input.unused, ", "));
}

}  // namespace perilink
