#include "io/case/binding/key_binding.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "material/force_curve.hpp"

namespace perilink {
namespace {

std::string name_of(const KeySchema& key) { return std::string(key.name); }

/// Returns the text between quotes of a line of TOML.
std::string word_in(const std::string& line) {
  const std::size_t first = line.find('"');
  return first == line.npos ? "" : line.substr(first + 1, line.rfind('"') - first - 1);
}

const KeySchema& key_of(const TableSchema& schema, std::string_view name) {
  const auto found = std::ranges::find(schema.keys, name, &KeySchema::name);
  if (found == schema.keys.end()) throw std::logic_error("no key " + std::string(name));
  return *found;
}

bool is_chosen(const KeySchema& key, std::string_view word) {
  return key.choice.empty() || std::ranges::find(key.chosen, word) != key.chosen.end();
}

/// Returns the word of the key that decides whether a key is allowed.
std::string word_of(const TableSchema& schema, const KeySchema& key, const CaseTable& table) {
  const std::string choice(key.choice);
  const KeySchema& decides = key_of(schema, choice);
  if (table.has(choice)) return *table.choice(choice, decides.values.words);
  return word_in(decides.fallback(decides));
}

/// Whether the keys that a key depends on allow it.
bool is_allowed(const TableSchema& schema, const KeySchema& key, const CaseTable& table) {
  return (key.companion.empty() || table.has(std::string(key.companion))) &&
         (key.choice.empty() || is_chosen(key, word_of(schema, key, table)));
}

/// Checks the value of a key that is read by hand, if its row describes the value.
void check_value(const KeySchema& key, const CaseTable& table, Kinds kind) {
  using Type = Values::Kind;
  const Type type = key.values.kind;
  double number{};
  int integer{};
  bool boolean{};
  if (!key.values.words.empty()) {
    table.choice(name_of(key), key.values.words);
  } else if (type == Type::number && !key.values.list) {
    binding::read_value(key, table, kind, number);
  } else if (type == Type::integer || type == Type::normal) {
    binding::read_value(key, table, kind, integer);
  } else if (type == Type::boolean) {
    binding::read_value(key, table, kind, boolean);
  }
}

/// Refuses a key that another key of the table excludes, or that needs another one.
void check_companions(const TableSchema& schema, const KeySchema& key, const CaseTable& table) {
  const std::string name = name_of(key);
  if (!key.rival.empty() && table.has(std::string(key.rival))) {
    table.refuse(name, fmt::format("is given together with `{}`", key.rival),
                 "delete one of the two");
  }
  if (!key.companion.empty() && !table.has(std::string(key.companion))) {
    table.refuse(name, fmt::format("is given without `{}`", key.companion),
                 fmt::format("delete it, or give `{}`", key.companion));
  }
  if (key.choice.empty()) return;
  const std::string word = word_of(schema, key, table);
  if (is_chosen(key, word)) return;
  table.refuse(name, fmt::format("is given, but {} is \"{}\"", key.choice, word),
               fmt::format("delete it, or set {} = \"{}\"", key.choice, key.chosen.front()));
}

}  // namespace

namespace binding {

std::vector<std::array<double, 2>> read_curve(const CaseTable& table, const std::string& key) {
  const auto points = table.vectors(key, 2).value_or(std::vector<Vector3>());
  std::vector<std::array<double, 2>> curve;
  for (const Vector3& point : points) curve.push_back({point[0], point[1]});
  try {
    check_curve({curve});
  } catch (const std::invalid_argument& error) {
    table.refuse(key, fmt::format("is not a valid curve: {}", error.what()),
                 "write points from the end of the first straight line on: [[0.1, 4], [1, 10]]");
  }
  return curve;
}

void check_numbers(const KeySchema& key, const CaseTable& table, std::span<const double> numbers) {
  for (const double number : numbers) {
    table.check_range(name_of(key), number, key.values.range, key.hint);
  }
  const auto fault = std::ranges::adjacent_find(numbers, std::greater_equal());
  if (!key.sorted || fault == numbers.end()) return;
  table.refuse(name_of(key),
               fmt::format("has {} after {}, but the numbers must ascend", fault[1], fault[0]),
               std::string(key.hint));
}

}  // namespace binding

void read_keys(const TableSchema& schema, const CaseTable& table, Kinds kind, void* section,
               void* others) {
  for (const KeySchema& key : schema.keys) {
    if (!table.has(name_of(key))) continue;
    if (!key.read) {
      check_value(key, table, kind);
      continue;
    }
    const bool used = key.always || exception_of(key.not_for, kind) == nullptr;
    key.read(key, table, used ? section : others, kind);
  }
  for (const auto& group : schema.one_of) {
    std::vector<std::string> names;
    for (const std::string_view name : group) {
      if (exception_of(key_of(schema, name).not_for, kind) == nullptr) names.emplace_back(name);
    }
    if (!names.empty()) table.need_one_of(names);
  }
  for (const KeySchema& key : schema.keys) {
    if (table.has(name_of(key))) {
      check_companions(schema, key, table);
    } else if (!key.missing.empty() && exception_of(key.not_for, kind) == nullptr &&
               is_allowed(schema, key, table)) {
      table.refuse_missing(name_of(key), std::string(key.missing));
    }
  }
}

void write_keys(const TableSchema& schema, TomlWriter& out, Kinds kind, const void* section,
                std::string_view without) {
  for (const KeySchema& key : schema.keys) {
    if (!key.write || key.name == without) continue;
    if (!key.always && exception_of(key.not_for, kind) != nullptr) continue;
    if (!key.choice.empty()) {
      const KeySchema& choice = key_of(schema, key.choice);
      TomlWriter word;
      choice.write(choice, word, section, kind);
      if (!is_chosen(key, word_in(word.take()))) continue;
    }
    key.write(key, out, section, kind);
  }
}

}  // namespace perilink
