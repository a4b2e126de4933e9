#pragma once

#include <array>
#include <cmath>
#include <concepts>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

#include "io/case/case_file.hpp"
#include "io/case/case_keys.hpp"
#include "io/case/case_schema.hpp"
#include "io/case/case_table.hpp"
#include "io/text/toml_writer.hpp"

/// \file Binds keys to members of the sections of a case.

namespace perilink {

/// Returns the number of coordinates of a position: 2 or 3.
constexpr int dimension_of(Kinds kind) { return (kind & kinds::space) != 0 ? 3 : 2; }
/// Returns the number of components of displacements and loads: 2 or 3.
constexpr int axes_of(Kinds kind) { return (kind & (kinds::space | kinds::shell)) != 0 ? 3 : 2; }

namespace binding {

template <class T>
struct Element {
  using type = T;
  static constexpr bool is_list = false, is_optional = false;
};
template <class T>
struct Element<std::optional<T>> : Element<T> {
  static constexpr bool is_optional = true;
};
template <class T>
struct Element<std::vector<T>> {
  using type = T;
  static constexpr bool is_list = true, is_optional = false;
};

/// Describes values by the type of their member.
template <class T>
Values values_of(Values given) {
  using Kind = Values::Kind;
  using E = typename Element<T>::type;
  if constexpr (std::is_enum_v<E>) {
    constexpr auto words = words_of(E{});
    return Values({words.begin(), words.end()});
  }
  if (given.kind == Kind::by_type) {
    given.kind = std::same_as<E, bool>               ? Kind::boolean
                 : std::same_as<E, double>           ? Kind::number
                 : std::same_as<E, std::string>      ? Kind::text
                 : std::same_as<E, Vector3>          ? Kind::components
                 : std::same_as<E, Expression>       ? Kind::formula
                 : std::same_as<E, ExpressionVector> ? Kind::formulas
                                                     : Kind::integer;
    if constexpr (Element<T>::is_list) {
      if (given.kind == Kind::components)
        given.kind = Kind::points;
      else
        given.list = true;
    }
  }
  return given;
}

std::vector<std::array<double, 2>> read_curve(const CaseTable& table, const std::string& key);
/// Refuses numbers outside of the range of a key, or out of order.
void check_numbers(const KeySchema& key, const CaseTable& table, std::span<const double> numbers);

/// Reads a value of a table that has the key.
template <class T>
void read_value(const KeySchema& key, const CaseTable& table, Kinds kind, T& value) {
  using Kind = Values::Kind;
  const std::string name(key.name);
  const Values& values = key.values;
  const bool of_body = values.kind == Kind::position || values.kind == Kind::normal;
  const int size = of_body ? dimension_of(kind) : axes_of(kind);
  const int lowest = std::isfinite(values.range.least) ? static_cast<int>(values.range.least) : 0;
  const int highest = std::isfinite(values.range.most) ? static_cast<int>(values.range.most) : 0;
  if constexpr (Element<T>::is_optional) {
    read_value(key, table, kind, value.emplace());
  } else if constexpr (std::is_enum_v<T>) {
    value = *table.choice<T>(name);
  } else if constexpr (std::same_as<T, bool>) {
    value = *table.boolean(name);
  } else if constexpr (std::integral<T>) {
    value = values.kind == Kind::integer
                ? *table.integer(name, lowest, highest)
                : table.choice(name, {axis_names.begin(), axis_names.begin() + size})->at(0) - 'x';
  } else if constexpr (std::same_as<T, double>) {
    value = values.kind == Kind::energy ? table.energy(name)
                                        : *table.number(name, values.range, key.hint);
  } else if constexpr (std::same_as<T, std::string>) {
    value = *table.text(name);
  } else if constexpr (std::same_as<T, Expression>) {
    value = *table.expression(name, dimension_of(kind));
  } else if constexpr (std::same_as<T, ExpressionVector>) {
    value = *table.expressions(name, size, dimension_of(kind));
  } else if constexpr (std::same_as<T, Vector3>) {
    value = *table.vector(name, size);
    check_numbers(key, table, value);
  } else if constexpr (std::same_as<T, std::vector<double>>) {
    value = *table.numbers(name);
    check_numbers(key, table, value);
  } else if constexpr (std::same_as<T, std::vector<int>>) {
    value = *table.integers(name, lowest, highest);
    check_numbers(key, table, std::vector<double>(value.begin(), value.end()));
  } else if constexpr (std::same_as<T, std::vector<std::string>>) {
    value = *table.texts(name);
  } else if constexpr (std::same_as<T, std::vector<Vector3>>) {
    value = *table.vectors(name, dimension_of(kind));
  } else {
    value = read_curve(table, name);
  }
}

/// Writes a value, if it is given.
template <class T>
void write_value(const KeySchema& key, TomlWriter& out, const T& value, Kinds kind) {
  using Kind = Values::Kind;
  if constexpr (Element<T>::is_optional) {
    if (value) write_value(key, out, *value, kind);
  } else if constexpr (std::is_enum_v<T>) {
    out.write(key.name, word_of(value));
  } else if constexpr (std::same_as<T, double>) {
    if (key.values.kind == Kind::energy && value == infinity) {
      out.write(key.name, infinite_energy);
    } else {
      out.write(key.name, value);
    }
  } else if constexpr (std::same_as<T, Vector3> || std::same_as<T, ExpressionVector>) {
    out.write(key.name, value,
              key.values.kind == Kind::position ? dimension_of(kind) : axes_of(kind));
  } else if constexpr (Element<T>::is_list || std::same_as<T, std::string>) {
    if (value.empty() && !key.empty_too) return;
    if constexpr (std::same_as<T, std::vector<Vector3>>) {
      out.write(key.name, value, dimension_of(kind));
    } else {
      out.write(key.name, value);
    }
  } else if constexpr (std::integral<T> && !std::same_as<T, bool>) {
    const bool axis = key.values.kind == Kind::axis || key.values.kind == Kind::normal;
    if (axis) return out.write(key.name, axis_names[value]);
    out.write(key.name, static_cast<int>(value));
  } else {
    out.write(key.name, value);
  }
}

}  // namespace binding

/// Returns a section whose members all exist, for defaults and for keys that are checked only.
template <class Section>
Section fresh_section() {
  Section section;
  if constexpr (std::same_as<Section, MaterialSection>) section.lattice.emplace();
  return section;
}

/// Returns a key whose value is a member of a section.
/// \param member  pointer to it, or a function that returns a reference
template <class Section, class Member>
KeySchema key(const char* name, Member member, Values values = {},
              std::vector<NotFor> not_for = {}) {
  using T = std::decay_t<std::invoke_result_t<Member, Section&>>;
  KeySchema row(name, binding::values_of<T>(std::move(values)), std::move(not_for));
  row.section = &typeid(Section);
  row.read = [member](const KeySchema& self, const CaseTable& table, void* section, Kinds kind) {
    binding::read_value(self, table, kind, std::invoke(member, *static_cast<Section*>(section)));
  };
  row.write = [member](const KeySchema& self, TomlWriter& out, const void* section, Kinds kind) {
    auto& from = *static_cast<Section*>(const_cast<void*>(section));
    binding::write_value(self, out, std::invoke(member, from), kind);
  };
  row.fallback = [member](const KeySchema& self) {
    auto section = fresh_section<Section>();
    TomlWriter out;
    binding::write_value(self, out, std::invoke(member, section), kinds::plane);
    return out.take();
  };
  return row;
}
template <class Section, class T>
KeySchema key(const char* name, T Section::*member, Values values = {},
              std::vector<NotFor> not_for = {}) {
  return key<Section, T Section::*>(name, member, std::move(values), std::move(not_for));
}

/// Reads the bound keys of a table and checks the rules of all its keys: first the values, then
/// which keys are missing or exclude each other.
/// \param section  receives the values that the kind of case uses
/// \param others   receives the values that are checked only
void read_keys(const TableSchema& schema, const CaseTable& table, Kinds kind, void* section,
               void* others);
/// Writes the bound keys of a table that the kind of case uses.
/// \param without  key that is left out
void write_keys(const TableSchema& schema, TomlWriter& out, Kinds kind, const void* section,
                std::string_view without);

/// Reads the bound keys of a table of case_schema().
template <class Section>
Section read_section(std::string_view name, const CaseTable& table, Kinds kind,
                     Section section = {}) {
  auto others = fresh_section<Section>();
  read_keys(table_schema(name), table, kind, &section, &others);
  return section;
}
template <class Section>
void write_section(std::string_view name, TomlWriter& out, Kinds kind, const Section& section,
                   std::string_view without = "") {
  write_keys(table_schema(name), out, kind, &section, without);
}

}  // namespace perilink
