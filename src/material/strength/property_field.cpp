#include "material/strength/property_field.hpp"

#include <algorithm>
#include <cstddef>
#include <functional>
#include <utility>

namespace perilink {

std::vector<double> factors_between(const PropertyField& field, std::span<const double> positions,
                                    int dim, std::span<const Index> first,
                                    std::span<const Index> second) {
  std::vector<double> values;
  if (!field.factor) {
    values = normal_field(field.random, positions, dim, first, second);
    std::ranges::transform(values, values.begin(),
                           UnitMean(field.random.distribution, field.random.variation));
    return values;
  }
  std::vector<double> middle(static_cast<std::size_t>(dim));
  values.reserve(first.size());
  for (std::size_t k = 0; k < first.size(); ++k) {
    const double* from = positions.data() + static_cast<std::size_t>(first[k]) * dim;
    const double* to = positions.data() + static_cast<std::size_t>(second[k]) * dim;
    for (int a = 0; a < dim; ++a) middle[a] = 0.5 * (from[a] + to[a]);
    values.push_back(field.factor(middle));
  }
  return values;
}

std::vector<double> modulus_between(std::span<const PropertyField> fields,
                                    std::span<const double> positions, int dim,
                                    std::span<const Index> first, std::span<const Index> second) {
  std::vector<double> product;
  for (const PropertyField& field : fields) {
    if (field.property != VaryingProperty::youngs_modulus) continue;
    std::vector<double> own = factors_between(field, positions, dim, first, second);
    if (!product.empty()) std::ranges::transform(own, product, own.begin(), std::multiplies<>());
    product = std::move(own);
  }
  return product;
}

}  // namespace perilink
