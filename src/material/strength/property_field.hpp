#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "base/types.hpp"
#include "material/strength/random_field.hpp"

/// \file
/// Properties that vary in space (docs/theory/softening.md, section 12).

namespace perilink {

/// A property of materials that varies in space: a factor on the value of the material. Young's
/// modulus varies by one factor in all materials.
struct PropertyField {
  VaryingProperty property = VaryingProperty::tensile_strength;
  RandomField random;
  std::vector<std::uint8_t> varies;  ///< nonzero: the property of the material varies; per material
  /// Positive factor at a position; empty: the random field.
  std::function<double(std::span<const double>)> factor = {};
};

/// Returns the factors of a field in the middle between pairs of points [-].
/// \param positions  shape (points, dim) [length]
std::vector<double> factors_between(const PropertyField& field, std::span<const double> positions,
                                    int dim, std::span<const Index> first,
                                    std::span<const Index> second);

/// Returns Young's modulus in the middle between pairs of points over that of the material [-], the
/// product over all fields of the modulus; empty: it does not vary.
std::vector<double> modulus_between(std::span<const PropertyField> fields,
                                    std::span<const double> positions, int dim,
                                    std::span<const Index> first, std::span<const Index> second);

}  // namespace perilink
