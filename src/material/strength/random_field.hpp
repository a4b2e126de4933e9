#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/types.hpp"

/// \file
/// Random fields of place with unit mean, for properties that scatter
/// (docs/theory/softening.md, section 12).

namespace perilink {

/// Properties of a material that may vary in space.
enum class VaryingProperty { tensile_strength, fracture_energy, youngs_modulus };

/// Distributions of the values at one place.
enum class Distribution { normal, lognormal, weibull };

/// A normal field z of zero mean, unit variance and the correlation exp(-(r/l)^2), mapped to a
/// distribution of unit mean.
struct RandomField {
  Distribution distribution = Distribution::weibull;
  double variation = 0.1;           ///< standard deviation over mean [-]
  double correlation_length = 1.0;  ///< l [length]
  std::uint64_t seed = 1;
};

/// Largest variation of normal values, which are cut off at three standard deviations.
constexpr double most_normal_variation = 0.3;

/// Maps normal values to values of a distribution with unit mean and a given variation, both exact.
class UnitMean {
 public:
  /// \param variation  standard deviation over mean, at most most_normal_variation or 1 [-]
  UnitMean(Distribution distribution, double variation);

  /// Returns the value with the probability of a standard normal value; positive.
  double operator()(double z) const;

 private:
  Distribution distribution_;
  double variation_;
  double shape_;  ///< of Weibull's distribution; of a lognormal one the deviation of the logarithm
};

/// Returns the normal field z in the middle between pairs of points, as a sum of random waves
/// (spectral method, Shinozuka & Deodatis 1991). The numbers follow from the seed alone, by the
/// generator mt19937_64. The cost grows with pairs and points.
/// \param positions  shape (points, dim) [length]
std::vector<double> normal_field(const RandomField& field, std::span<const double> positions,
                                 int dim, std::span<const Index> first,
                                 std::span<const Index> second);

}  // namespace perilink
