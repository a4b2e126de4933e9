#pragma once

#include <string>
#include <string_view>

#include "io/text/toml_tree.hpp"

namespace perilink {

/// Units of a case, from a text such as "kN, m, s"; empty: unknown.
struct UnitNames {
  std::string force, length, time;

  /// \param units  of force, of length and, optionally, of time
  static UnitNames of(const std::string& units);
};

/// Returns the unit of a key of a case or a summary, a column of a history or a field: "N/mm²" for
/// youngs_modulus. Empty where it is unknown or the quantity has none.
std::string unit_of_quantity(std::string_view name, const UnitNames& units);

/// Returns the unit of a column of a history: of a quantity, or of a gauge, which measures a
/// displacement, stress, force or moment.
/// \param root  the case
std::string unit_of_column(const std::string& name, const TomlValue& root, const UnitNames& units);

/// Returns a name with blanks instead of underscores.
std::string in_words(std::string_view name);

}  // namespace perilink
