#pragma once

#include <array>
#include <memory>
#include <span>
#include <string>

#include "base/types.hpp"

namespace perilink {

/// A value of the case file: a number or a formula of the reference position.
struct Expression {
  Expression(double value = 0.0) : number(value) {}
  explicit Expression(std::string text) : formula(std::move(text)) {}

  double number = 0.0;
  std::string formula;  ///< "1 - y^2/4"; empty: the number is used

  bool is_constant() const { return formula.empty(); }
  bool is_zero() const { return formula.empty() && number == 0.0; }
  bool operator==(const Expression&) const = default;
};

/// Components along x, y, z; two-dimensional bodies leave the third one zero.
struct ExpressionVector : std::array<Expression, 3> {
  ExpressionVector() = default;
  ExpressionVector(const Vector3& numbers) : array{numbers[0], numbers[1], numbers[2]} {}

  bool is_constant() const;
  bool is_zero() const;
};

/// A parsed expression, which hides muParser.
class Formula {
 public:
  /// \param dim  2: the formula may hold x and y; 3: also z
  /// \throws std::invalid_argument  with the fault and its character, from one
  Formula(const Expression& expression, int dim);
  ~Formula();
  Formula(Formula&&) noexcept;

  /// \param position  size dim [length]
  /// \return the value, which may be infinite or not a number
  double at(std::span<const double> position) const;

 private:
  struct Parsed;
  double number_;
  std::unique_ptr<Parsed> parsed_;  // null: a number
};

}  // namespace perilink
