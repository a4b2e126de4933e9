#include "io/text/formula.hpp"

#include <fmt/format.h>
#include <muParser.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace perilink {
namespace {

/// Refuses equals signs: muParser would read x = 3 as an assignment.
void refuse_assignment(const std::string& text) {
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] != '=') continue;
    if (i + 1 < text.size() && text[i + 1] == '=') {
      ++i;
      continue;
    }
    if (i > 0 && (text[i - 1] == '<' || text[i - 1] == '>' || text[i - 1] == '!')) continue;
    throw std::invalid_argument(
        fmt::format("an equals sign at character {}; a formula is one value", i + 1));
  }
}

}  // namespace

bool ExpressionVector::is_constant() const {
  return std::all_of(begin(), end(), [](const Expression& e) { return e.is_constant(); });
}

bool ExpressionVector::is_zero() const {
  return std::all_of(begin(), end(), [](const Expression& e) { return e.is_zero(); });
}

struct Formula::Parsed {
  mu::Parser parser;
  Vector3 position{};
};

Formula::Formula(const Expression& expression, int dim) : number_(expression.number) {
  if (expression.is_constant()) return;
  refuse_assignment(expression.formula);
  parsed_ = std::make_unique<Parsed>();
  try {
    mu::Parser& parser = parsed_->parser;
    parser.ClearConst();
    parser.DefineConst("pi", std::numbers::pi);
    parser.DefineConst("e", std::numbers::e);
    for (int axis = 0; axis < dim; ++axis) {
      parser.DefineVar(std::string(1, "xyz"[axis]), &parsed_->position[axis]);
    }
    parser.SetExpr(expression.formula);
    int values = 0;
    parser.Eval(values);  // the first evaluation parses
    if (values != 1) {
      throw std::invalid_argument(fmt::format("{} values with commas between them", values));
    }
  } catch (const mu::Parser::exception_type& error) {
    std::string message = error.GetMsg();
    if (!message.empty() && message.back() == '.') message.pop_back();
    // Only some messages of muParser have a position ("position 4"), counted from zero.
    const std::size_t place = message.find(" found at position");
    if (place != std::string::npos) message.resize(place);
    const std::size_t at =
        std::min(static_cast<std::size_t>(std::max(error.GetPos(), 0)), expression.formula.size());
    throw std::invalid_argument(fmt::format("{} at character {}", message, at + 1));
  }
}

Formula::~Formula() = default;
Formula::Formula(Formula&&) noexcept = default;

double Formula::at(std::span<const double> position) const {
  if (!parsed_) return number_;
  std::copy(position.begin(), position.end(), parsed_->position.begin());
  return parsed_->parser.Eval();
}

}  // namespace perilink
