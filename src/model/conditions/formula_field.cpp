#include "model/conditions/formula_field.hpp"

#include <fmt/format.h>

#include <cmath>

#include "base/error.hpp"
#include "base/plain_text.hpp"
#include "io/case/sections/case_kinds.hpp"

namespace perilink {

PositionField::PositionField(const CaseFile& input, std::string key,
                             std::span<const Expression> components)
    : input_(input), key_(std::move(key)) {
  for (const Expression& component : components) {
    formulas_.emplace_back(component, dimension_of(input.body));
  }
}

Vector3 PositionField::at(std::span<const double> position) const {
  Vector3 values{};
  for (std::size_t k = 0; k < formulas_.size(); ++k) {
    values[k] = formulas_[k].at(position);
    if (std::abs(values[k]) <= largest_value) continue;
    throw InputError(
        input_.where(key_), fmt::format("is {} at the position ({})", values[k], joined(position)),
        fmt::format("write a formula that is finite and below {:.0e} wherever it is used",
                    largest_value));
  }
  return values;
}

}  // namespace perilink
