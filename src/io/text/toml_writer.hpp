#pragma once

#include <fmt/format.h>

#include <array>
#include <iterator>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/types.hpp"
#include "io/text/formula.hpp"

namespace perilink {

/// Writes TOML, one call per line.
class TomlWriter {
 public:
  void header(std::string_view name) { append("\n{}\n", name); }

  /// \param value  TOML text
  void line(std::string_view key, std::string_view value) { append("{} = {}\n", key, value); }

  void write(std::string_view key, double value) { line(key, fmt::format("{}", value)); }
  void write(std::string_view key, int value) { line(key, fmt::format("{}", value)); }
  void write(std::string_view key, bool value) { line(key, value ? "true" : "false"); }
  void write(std::string_view key, std::string_view value) { line(key, text(value)); }
  /// Without this overload a string literal would be converted to bool.
  void write(std::string_view key, const char* value) { line(key, text(value)); }
  void write(std::string_view key, const Vector3& value, int dim) {
    line(key, list(std::vector<double>(value.begin(), value.begin() + dim)));
  }
  void write(std::string_view key, const Expression& value) { line(key, element(value)); }
  void write(std::string_view key, const ExpressionVector& value, int dim) {
    line(key, list(std::vector<Expression>(value.begin(), value.begin() + dim)));
  }
  void write(std::string_view key, const std::vector<Vector3>& points, int dim) {
    std::vector<std::vector<double>> rows;
    for (const Vector3& x : points) rows.emplace_back(x.begin(), x.begin() + dim);
    line(key, list(rows));
  }
  template <class T>
  void write(std::string_view key, const std::vector<T>& values) {
    line(key, list(values));
  }
  template <class T>
  void write(std::string_view key, const std::optional<T>& value) {
    if (value) write(key, *value);
  }

  std::string take() { return std::move(text_); }

 private:
  template <class... Arguments>
  void append(fmt::format_string<Arguments...> format, Arguments&&... arguments) {
    text_ += fmt::vformat(format, fmt::make_format_args(arguments...));
  }

  static std::string text(std::string_view value) {
    std::string result = "\"";
    for (const char c : value) {
      if (c == '"' || c == '\\') result += '\\';
      result += c;
    }
    return result + "\"";
  }

  static std::string element(double value) { return fmt::format("{}", value); }
  static std::string element(int value) { return fmt::format("{}", value); }
  static std::string element(const std::string& value) { return text(value); }
  static std::string element(const Expression& value) {
    return value.is_constant() ? element(value.number) : text(value.formula);
  }
  static std::string element(const std::vector<double>& value) { return list(value); }
  static std::string element(const std::array<double, 2>& value) {
    return list(std::vector<double>(value.begin(), value.end()));
  }

  template <class T>
  static std::string list(const std::vector<T>& values) {
    std::string result = "[";
    for (const T& value : values) result += (result.size() > 1 ? ", " : "") + element(value);
    return result + "]";
  }

  std::string text_;
};

}  // namespace perilink
