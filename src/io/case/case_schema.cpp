#include "io/case/case_schema.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "base/error.hpp"
#include "io/case/case_file.hpp"

namespace perilink {
namespace {

/// Longer words are not misspellings of keys, and comparing them takes time.
constexpr std::size_t longest_word = 64;

/// Most names in a list of allowed words.
constexpr std::size_t longest_list = 20;

bool is_bare_key(const std::string& key) {
  return !key.empty() && key.size() <= longest_word &&
         std::all_of(key.begin(), key.end(), [](unsigned char c) {
           return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
                  c == '_' || c == '-';
         });
}

std::string join_path(std::string_view table, const std::string& key) {
  const std::string shown = is_bare_key(key) ? key : quoted(key);
  return table.empty() ? shown : fmt::format("{}.{}", table, shown);
}

bool has_key(const TableSchema& schema, const std::string& key) {
  return std::any_of(schema.keys.begin(), schema.keys.end(),
                     [&](const KeySchema& known) { return known.name == key; });
}

/// A document and its schema, for messages.
struct SchemaDocument {
  const std::string& path;
  const std::vector<TableSchema>& schema;
  std::string_view name;
};

/// Suggests the tables that have the key: it may stand below the wrong header.
std::string suggest_key(const SchemaDocument& document, const TableSchema& here,
                        const std::string& key) {
  std::string homes;
  for (const TableSchema& other : document.schema) {
    if (!has_key(other, key)) continue;
    homes += (homes.empty() ? "" : ", ") + header_of(other);
  }
  std::vector<std::string_view> keys;
  for (const KeySchema& known : here.keys) keys.push_back(known.name);
  const std::string allowed = suggest(key, keys);
  return homes.empty() ? allowed : fmt::format("`{}` belongs to {}. {}", key, homes, allowed);
}

void check_keys(const SchemaDocument& document, const TableSchema& schema, const TomlValue& table,
                const std::string& table_path) {
  if (table.kind != TomlValue::Kind::table) {
    throw InputError({document.path, table.line, table_path},
                     fmt::format("is {}, but must be a table", describe(table)),
                     fmt::format("write {} and its keys on the lines below", header_of(schema)));
  }
  for (const TomlValue& value : table.entries) {
    const std::string& key = value.key;
    if (has_key(schema, key)) continue;
    throw InputError({document.path, value.line, join_path(table_path, key)},
                     fmt::format("{} has no such key", header_of(schema)),
                     suggest_key(document, schema, key));
  }
}

void check_table(const SchemaDocument& document, const TableSchema& schema,
                 const TomlValue& value) {
  const std::string name(schema.name);
  if (!schema.list) {
    if (value.kind == TomlValue::Kind::array) {
      throw InputError(
          {document.path, value.line, name},
          fmt::format("is written as a list of tables [[{}]]", name),
          fmt::format("a {} has only one; write {}", document.name, header_of(schema)));
    }
    check_keys(document, schema, value, name);
    return;
  }
  if (value.kind != TomlValue::Kind::array) {
    throw InputError({document.path, value.line, name},
                     fmt::format("is {}, but must be a list of tables", describe(value)),
                     fmt::format("write {} with two brackets, once for each", header_of(schema)));
  }
  for (std::size_t i = 0; i < value.items.size(); ++i) {
    check_keys(document, schema, value.items[i], item_key(name, i));
  }
}

}  // namespace

bool NotFor::holds(Kinds kind) const {
  using namespace kinds;
  for (const Kinds group :
       {bond_based | micropolar | lattice | particles | elements, plane | space | shell | beam,
        damage | elastic | explicit_ | relaxation}) {
    if ((kinds & group) != 0 && (kinds & group & kind) == 0) return false;
  }
  return true;
}

std::string header_of(const TableSchema& schema) {
  if (schema.name.empty()) return "the top of the file";
  return schema.list ? fmt::format("[[{}]]", schema.name) : fmt::format("[{}]", schema.name);
}

bool Range::contains(double value) const {
  return (above ? value > least : value >= least) && (below ? value < most : value <= most);
}

const NotFor* exception_of(const std::vector<NotFor>& exceptions, Kinds kind) {
  const auto found = std::ranges::find_if(
      exceptions, [&](const NotFor& exception) { return exception.holds(kind); });
  return found == exceptions.end() ? nullptr : &*found;
}

void check_against_schema(const TomlValue& document, const std::string& path,
                          const std::vector<TableSchema>& schema, std::string_view document_name) {
  const SchemaDocument checked{path, schema, document_name};
  std::vector<std::string_view> tables;
  for (const TableSchema& table : schema) {
    if (!table.name.empty()) tables.push_back(table.name);
  }
  for (const TomlValue& value : document.entries) {
    const std::string& key = value.key;
    if (has_key(schema.front(), key)) continue;
    const auto found = std::find_if(schema.begin(), schema.end(),
                                    [name = std::string_view(key)](const auto& table) {
                                      return !name.empty() && table.name == name;
                                    });
    if (found != schema.end()) {
      check_table(checked, *found, value);
      continue;
    }
    const bool table = value.kind == TomlValue::Kind::table ||
                       (value.kind == TomlValue::Kind::array && !value.items.empty() &&
                        value.items.front().kind == TomlValue::Kind::table);
    throw InputError({path, value.line, join_path("", key)},
                     table ? fmt::format("a {} has no such table", document_name)
                           : "the top of the file has no such key",
                     table ? suggest(key, tables) : suggest_key(checked, schema.front(), key));
  }
}

int edit_distance(std::string_view a, std::string_view b) {
  std::vector<int> before_last(b.size() + 1);
  std::vector<int> last(b.size() + 1);
  std::vector<int> row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) row[j] = static_cast<int>(j);
  for (std::size_t i = 1; i <= a.size(); ++i) {
    before_last.swap(last);
    last.swap(row);
    row[0] = static_cast<int>(i);
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const int replaced = last[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, replaced});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) {
        row[j] = std::min(row[j], before_last[j - 2] + 1);
      }
    }
  }
  return row[b.size()];
}

std::string suggest(const std::string& word, const std::vector<std::string_view>& allowed) {
  const auto lower = [](std::string text) {
    for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return text;
  };
  std::string_view nearest;
  int least = 1 + std::max(2, static_cast<int>(word.size()) / 3);
  std::string list;
  for (std::size_t i = 0; i < allowed.size(); ++i) {
    const std::string_view candidate = allowed[i];
    if (i < longest_list) list += (i > 0 ? ", " : "") + std::string(candidate);
    if (i == longest_list) list += fmt::format(", and {} more", allowed.size() - i);
    if (word.size() > longest_word || candidate.size() > longest_word) continue;
    const int distance = edit_distance(lower(word), lower(std::string(candidate)));
    if (distance < least && distance < static_cast<int>(candidate.size())) {
      least = distance;
      nearest = candidate;
    }
  }
  const std::string all = fmt::format("Allowed: {}", list);
  return nearest.empty() ? all : fmt::format("did you mean `{}`? {}", nearest, all);
}

}  // namespace perilink
