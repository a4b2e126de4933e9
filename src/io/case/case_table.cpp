#include "io/case/case_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <stdexcept>

#include "base/plain_text.hpp"
#include "io/case/case_schema.hpp"

namespace perilink {
namespace {

/// Bounds of numbers: powers of numbers beyond them would leave the range of double precision (the
/// micromodulus has the horizon to the sixth).
constexpr double largest_number = 1e50;
constexpr double smallest_number = 1e-50;

/// Characters, enough for a sentence on a plot.
constexpr std::size_t longest_text = 200;

/// Linux's PATH_MAX.
constexpr std::size_t longest_path = 4096;

/// Characters, enough for body forces of manufactured solutions.
constexpr std::size_t longest_formula = 2000;

bool is_number(const std::string& text) {
  char* end = nullptr;
  std::strtod(text.c_str(), &end);
  return !text.empty() && std::isdigit(static_cast<unsigned char>(text.back())) != 0 &&
         end == text.c_str() + text.size();
}

}  // namespace

void CaseTable::refuse(const std::string& key, const std::string& fault,
                       const std::string& suggestion) const {
  const TomlValue* value = table_.find(key);
  const std::string full = key.empty()         ? key_path_
                           : key_path_.empty() ? key
                                               : key_path_ + "." + key;
  throw InputError({file_, value != nullptr ? value->line : table_.line, full}, fault, suggestion);
}

void CaseTable::refuse_missing(const std::string& key, const std::string& meaning) const {
  refuse(key, "is missing", fmt::format("give {}", meaning));
}

void CaseTable::need_one_of(const std::vector<std::string>& keys) const {
  std::string list;
  std::vector<std::string> given;
  for (std::size_t i = 0; i < keys.size(); ++i) {
    if (i > 0) list += i + 1 == keys.size() ? " or " : ", ";
    list += "`" + keys[i] + "`";
    if (has(keys[i])) given.push_back(keys[i]);
  }
  if (given.size() == 1) return;
  if (given.empty()) refuse("", fmt::format("has none of {}", list), "give exactly one of them");
  refuse(given[1], fmt::format("is given together with `{}`", given[0]),
         fmt::format("give only one of {}", list));
}

double CaseTable::checked_number(const std::string& key, const TomlValue& value) const {
  using Kind = TomlValue::Kind;
  if (value.kind != Kind::number && value.kind != Kind::integer) {
    refuse(key, fmt::format("is {}, but must be a number", describe(value)),
           value.kind == Kind::text ? "write numbers without quotes" : "");
  }
  if (!std::isfinite(value.number)) {
    refuse(key, fmt::format("is {}, but must be a finite number", describe(value)),
           "write digits, for example 1.5e3");
  }
  const double size = std::abs(value.number);
  if (size > largest_number || (size > 0.0 && size < smallest_number)) {
    refuse(key,
           fmt::format("is {}, too {} to compute with", describe(value),
                       size > largest_number ? "large" : "small"),
           fmt::format("use units in which sizes lie between {} and {}", smallest_number,
                       largest_number));
  }
  // Minus zero would be written as an integer, which has no sign of zero.
  return value.number == 0.0 ? 0.0 : value.number;
}

int CaseTable::checked_integer(const std::string& key, const TomlValue& value, int lowest,
                               int highest) const {
  if (value.kind != TomlValue::Kind::integer || value.integer < lowest || value.integer > highest) {
    refuse(key,
           fmt::format("is {}, but must be an integer from {} to {}", describe(value), lowest,
                       highest),
           "");
  }
  return static_cast<int>(value.integer);
}

std::string CaseTable::checked_text(const std::string& key, const TomlValue& value,
                                    std::size_t longest) const {
  if (value.kind != TomlValue::Kind::text) {
    refuse(key, fmt::format("is {}, but must be text", describe(value)),
           "write text between quotes");
  }
  if (printable(value.text) != value.text ||
      value.text.find_first_of("\n\t") != std::string::npos) {
    refuse(key, fmt::format("is {}, with characters that cannot be printed", describe(value)),
           "write one line of plain text");
  }
  if (value.text.size() > longest) {
    refuse(key, fmt::format("is {} characters long", value.text.size()),
           fmt::format("{} are allowed", longest));
  }
  return value.text;
}

std::optional<std::string> CaseTable::text(const std::string& key) const {
  const TomlValue* value = table_.find(key);
  if (value == nullptr) return std::nullopt;
  return checked_text(key, *value, longest_text);
}

std::optional<std::string> CaseTable::path(const std::string& key) const {
  const TomlValue* value = table_.find(key);
  if (value == nullptr) return std::nullopt;
  return checked_text(key, *value, longest_path);
}

std::optional<std::string> CaseTable::choice(const std::string& key,
                                             const std::vector<std::string_view>& allowed) const {
  const std::optional<std::string> word = text(key);
  if (word && std::find(allowed.begin(), allowed.end(), *word) == allowed.end()) {
    refuse(key, fmt::format("is {}, which is not one of the choices", quoted(*word)),
           suggest(*word, allowed));
  }
  return word;
}

std::optional<bool> CaseTable::boolean(const std::string& key) const {
  const TomlValue* value = table_.find(key);
  if (value == nullptr) return std::nullopt;
  if (value->kind != TomlValue::Kind::boolean) {
    refuse(key, fmt::format("is {}, but must be true or false", describe(*value)),
           "write true or false without quotes");
  }
  return value->boolean;
}

std::optional<int> CaseTable::integer(const std::string& key, int lowest, int highest) const {
  const TomlValue* value = table_.find(key);
  if (value == nullptr) return std::nullopt;
  return checked_integer(key, *value, lowest, highest);
}

std::optional<double> CaseTable::number(const std::string& key, const Range& range,
                                        std::string_view hint) const {
  const TomlValue* value = table_.find(key);
  if (value == nullptr) return std::nullopt;
  const double number = checked_number(key, *value);
  check_range(key, number, range, hint);
  return number;
}

void CaseTable::check_range(const std::string& key, double value, const Range& range,
                            std::string_view hint) const {
  if (range.contains(value)) return;
  const double least = range.least;
  const double most = range.most;
  const bool low = value <= least;
  const std::string limit =
      !low           ? fmt::format("be {} {}", range.below ? "less than" : "at most", most)
      : least == 0.0 ? range.above ? "be greater than zero" : "not be negative"
                     : fmt::format("be {} {}", range.above ? "more than" : "at least", least);
  const std::string advice =
      most == infinity
          ? least == 0.0 ? fmt::format("give {}a positive number", range.above ? "" : "zero or ")
                         : fmt::format("give {} or more", least)
      : range.above
          ? fmt::format("give a number between {} and {}", least, most)
          : fmt::format("give a number from {} to {}{}", least, range.below ? "below " : "", most);
  refuse(key, fmt::format("is {}, but must {}", value, limit),
         hint.empty() ? advice : std::string(hint));
}

double CaseTable::energy(const std::string& key) const {
  const TomlValue* value = table_.find(key);
  if (value->kind == TomlValue::Kind::text) {
    if (value->text == infinite_energy) return infinity;
    if (is_number(value->text)) {
      refuse(
          key,
          fmt::format("is the text {}, but must be a number or \"infinite\"", quoted(value->text)),
          fmt::format("write the number without quotes: {} = {}", key, value->text));
    }
    refuse(key, fmt::format("is {}, neither a number nor \"infinite\"", quoted(value->text)),
           "write numbers without quotes and units. " + suggest(value->text, {infinite_energy}));
  }
  if (value->kind == TomlValue::Kind::number && std::isinf(value->number)) {
    refuse(key, fmt::format("is {}", describe(*value)),
           fmt::format("write {} = \"infinite\"", key));
  }
  return *number(key, allowed::positive);
}

const TomlValue* CaseTable::array(const std::string& key, const char* of) const {
  const TomlValue* value = table_.find(key);
  if (value != nullptr && value->kind != TomlValue::Kind::array) {
    refuse(key, fmt::format("is {}, but must be a list of {}", describe(*value), of),
           "write the values between brackets: [..., ...]");
  }
  return value;
}

std::optional<std::vector<double>> CaseTable::numbers(const std::string& key) const {
  const TomlValue* list = array(key, "numbers");
  if (list == nullptr) return std::nullopt;
  std::vector<double> result;
  for (const TomlValue& item : list->items) result.push_back(checked_number(key, item));
  return result;
}

Vector3 CaseTable::checked_vector(const std::string& key, const TomlValue& list, int dim) const {
  if (list.items.size() != static_cast<std::size_t>(dim)) {
    refuse(key,
           fmt::format("has {}, but the body has {} dimensions",
                       counted(list.items.size(), "component"), dim),
           dim == 2 ? "write [x, y]" : "write [x, y, z]");
  }
  Vector3 result{};
  for (int axis = 0; axis < dim; ++axis) result[axis] = checked_number(key, list.items[axis]);
  return result;
}

std::optional<Vector3> CaseTable::vector(const std::string& key, int dim) const {
  const TomlValue* list = array(key, "numbers");
  if (list == nullptr) return std::nullopt;
  return checked_vector(key, *list, dim);
}

std::optional<std::vector<Vector3>> CaseTable::vectors(const std::string& key, int dim) const {
  const TomlValue* list = array(key, "points");
  if (list == nullptr) return std::nullopt;
  std::vector<Vector3> result;
  for (const TomlValue& item : list->items) {
    if (item.kind != TomlValue::Kind::array) {
      refuse(key, fmt::format("holds {}, but must be a list of points", describe(item)),
             dim == 2 ? "write [[x, y], [x, y]]" : "write [[x, y, z], [x, y, z], [x, y, z]]");
    }
    result.push_back(checked_vector(key, item, dim));
  }
  return result;
}

Expression CaseTable::checked_expression(const std::string& key, const TomlValue& value,
                                         int dim) const {
  if (value.kind != TomlValue::Kind::text) {
    if (value.kind != TomlValue::Kind::number && value.kind != TomlValue::Kind::integer) {
      refuse(key, fmt::format("is {}, but must be a number or a formula", describe(value)),
             "write a number, or a formula between quotes: \"1 - y^2/4\"");
    }
    return checked_number(key, value);
  }
  Expression expression(checked_text(key, value, longest_formula));
  try {
    if (expression.formula.empty()) throw std::invalid_argument("nothing at character 1");
    const Formula formula(expression, dim);
  } catch (const std::invalid_argument& error) {
    refuse(
        key, fmt::format("holds the formula {}: {}", quoted(expression.formula), error.what()),
        fmt::format("write a number, or a formula of {} with + - * / ^, pi, e and functions such "
                    "as sqrt, sin, cos, exp, ln, abs, min and max",
                    dim == 2 ? "x and y" : "x, y and z"));
  }
  return expression;
}

std::optional<Expression> CaseTable::expression(const std::string& key, int dim) const {
  const TomlValue* value = table_.find(key);
  if (value == nullptr) return std::nullopt;
  return checked_expression(key, *value, dim);
}

std::optional<ExpressionVector> CaseTable::expressions(const std::string& key, int axes,
                                                       int dim) const {
  const TomlValue* list = array(key, "numbers or formulas");
  if (list == nullptr) return std::nullopt;
  if (list->items.size() != static_cast<std::size_t>(axes)) {
    refuse(key,
           fmt::format("has {}, but the body has {} dimensions",
                       counted(list->items.size(), "component"), axes),
           axes == 2 ? "write [x, y]" : "write [x, y, z]");
  }
  ExpressionVector result;
  for (std::size_t k = 0; k < list->items.size(); ++k) {
    result[k] = checked_expression(key, list->items[k], dim);
  }
  return result;
}

std::optional<std::vector<int>> CaseTable::integers(const std::string& key, int lowest,
                                                    int highest) const {
  const TomlValue* list = array(key, "integers");
  if (list == nullptr) return std::nullopt;
  std::vector<int> result;
  for (const TomlValue& item : list->items) {
    result.push_back(checked_integer(key, item, lowest, highest));
  }
  return result;
}

std::optional<std::vector<std::string>> CaseTable::texts(const std::string& key) const {
  const TomlValue* list = array(key, "names");
  if (list == nullptr) return std::nullopt;
  std::vector<std::string> result;
  for (const TomlValue& item : list->items) result.push_back(checked_text(key, item, longest_text));
  return result;
}

}  // namespace perilink
