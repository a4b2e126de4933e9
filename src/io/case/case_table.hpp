#pragma once

#include <algorithm>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.hpp"
#include "base/types.hpp"
#include "io/case/case_schema.hpp"
#include "io/case/case_words.hpp"
#include "io/text/formula.hpp"
#include "io/text/toml_tree.hpp"

namespace perilink {

/// Word for the fracture energy of unbreakable materials.
inline constexpr const char* infinite_energy = "infinite";

/// Reads checked values of one table of a case. Every reader returns std::nullopt where the key is
/// absent. It throws InputError for a wrong type or a value out of range.
class CaseTable {
 public:
  /// \param table     must outlive this object
  /// \param key_path  "body" or "materials[2]"; empty: the top of the file
  CaseTable(const TomlValue& table, std::string key_path, std::string file)
      : table_(table), key_path_(std::move(key_path)), file_(std::move(file)) {}

  /// Whether the file has the table.
  bool exists() const { return table_.line != 0; }
  bool has(const std::string& key) const { return table_.find(key) != nullptr; }

  /// Reads one printable line.
  std::optional<std::string> text(const std::string& key) const;
  /// Reads the path of a file.
  std::optional<std::string> path(const std::string& key) const;
  /// Reads one of the allowed words.
  std::optional<std::string> choice(const std::string& key,
                                    const std::vector<std::string_view>& allowed) const;
  /// Reads a word of an enumeration.
  template <class Enumeration>
  std::optional<Enumeration> choice(const std::string& key) const {
    constexpr auto words = words_of(Enumeration{});
    const auto word = choice(key, {words.begin(), words.end()});
    if (!word) return std::nullopt;
    return static_cast<Enumeration>(std::find(words.begin(), words.end(), *word) - words.begin());
  }
  std::optional<bool> boolean(const std::string& key) const;
  std::optional<int> integer(const std::string& key, int lowest, int highest) const;
  /// Reads a number; integers are allowed.
  /// \param hint  suggestion for numbers out of range; empty: the range
  std::optional<double> number(const std::string& key, const Range& range = {},
                               std::string_view hint = {}) const;
  /// Reads a positive number, or infinity for the word "infinite", where the table has the key.
  double energy(const std::string& key) const;
  std::optional<std::vector<double>> numbers(const std::string& key) const;
  /// Reads as many numbers as the body has dimensions.
  std::optional<Vector3> vector(const std::string& key, int dim) const;
  /// Reads a number or a formula of the position.
  std::optional<Expression> expression(const std::string& key, int dim) const;
  /// Reads one number or formula for each of the axes, with formulas of a position in `dim`
  /// dimensions.
  std::optional<ExpressionVector> expressions(const std::string& key, int axes, int dim) const;
  /// Reads a list of points.
  std::optional<std::vector<Vector3>> vectors(const std::string& key, int dim) const;
  std::optional<std::vector<int>> integers(const std::string& key, int lowest, int highest) const;
  std::optional<std::vector<std::string>> texts(const std::string& key) const;

  /// Returns the value, or refuses the table with what is missing.
  template <class T>
  T need(const std::string& key, std::optional<T> value, const std::string& meaning) const {
    if (!value) refuse_missing(key, meaning);
    return *std::move(value);
  }

  /// Refuses a table that does not have exactly one of these keys.
  void need_one_of(const std::vector<std::string>& keys) const;

  /// Refuses a number out of range.
  void check_range(const std::string& key, double value, const Range& range,
                   std::string_view hint = {}) const;

  [[noreturn]] void refuse(const std::string& key, const std::string& fault,
                           const std::string& suggestion) const;
  [[noreturn]] void refuse_missing(const std::string& key, const std::string& meaning) const;

  /// Returns the value as written, for messages.
  const TomlValue* value(const std::string& key) const { return table_.find(key); }

 private:
  double checked_number(const std::string& key, const TomlValue& value) const;
  int checked_integer(const std::string& key, const TomlValue& value, int lowest,
                      int highest) const;
  std::string checked_text(const std::string& key, const TomlValue& value,
                           std::size_t longest) const;
  Expression checked_expression(const std::string& key, const TomlValue& value, int dim) const;
  Vector3 checked_vector(const std::string& key, const TomlValue& list, int dim) const;
  const TomlValue* array(const std::string& key, const char* of) const;

  const TomlValue& table_;
  std::string key_path_;
  std::string file_;
};

/// Overwrites a default where the file has a value.
template <class T>
void assign(T& target, std::optional<T> value) {
  if (value) target = *std::move(value);
}

}  // namespace perilink
