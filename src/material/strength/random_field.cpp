#include "material/strength/random_field.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <random>

namespace perilink {
namespace {

/// Waves of a field. The correlation of one field differs from that of the mean over all seeds by
/// about 1 / sqrt(2 waves).
constexpr int waves = 256;

/// Standard deviations at which normal values are cut off.
constexpr double cut_off = 3.0;

double density(double z) { return std::exp(-0.5 * z * z) / std::sqrt(2.0 * std::numbers::pi); }
double probability(double z) { return 0.5 * std::erfc(-z / std::numbers::sqrt2); }

/// Returns the value of a normal distribution cut off on both sides that has the probability of z
/// in the whole one. Newton's method converges from either side of the root: the distribution is
/// concave on this side of its mean.
double cut(double z) {
  const double outside = probability(-cut_off);
  const double aim = outside + probability(-std::abs(z)) * (1.0 - 2.0 * outside);
  double x = std::min(std::abs(z), cut_off);
  for (int round = 0; round < 8; ++round) x += (probability(-x) - aim) / density(x);
  return std::copysign(x, z);
}

/// Returns the shape of the Weibull distribution with a variation, by bisection.
double weibull_shape(double variation) {
  double low = 1.0, high = 2.0 / variation;
  for (int round = 0; round < 60; ++round) {
    const double shape = 0.5 * (low + high);
    const double mean = std::tgamma(1.0 + 1.0 / shape);
    const double own = std::sqrt(std::tgamma(1.0 + 2.0 / shape) / (mean * mean) - 1.0);
    (own > variation ? low : high) = shape;
  }
  return 0.5 * (low + high);
}

/// Random numbers with the same values on every platform; distributions of the library differ.
class Numbers {
 public:
  explicit Numbers(std::uint64_t seed) : bits_(seed) {}

  /// Returns a number in (0, 1].
  double uniform() { return (static_cast<double>(bits_() >> 11) + 1.0) * 0x1p-53; }
  /// Returns the amplitude of two independent normal numbers (Box & Muller 1958).
  double amplitude() { return std::sqrt(-2.0 * std::log(uniform())); }
  double phase() { return 2.0 * std::numbers::pi * uniform(); }
  double normal() {
    const double size = amplitude();
    return size * std::cos(phase());
  }

 private:
  std::mt19937_64 bits_;
};

}  // namespace

UnitMean::UnitMean(Distribution distribution, double variation)
    : distribution_(distribution), variation_(variation), shape_(0.0) {
  if (distribution == Distribution::lognormal) {
    shape_ = std::sqrt(std::log1p(variation * variation));
  } else if (distribution == Distribution::weibull) {
    shape_ = weibull_shape(variation);
  } else {
    // The cut lowers the deviation, which is restored here.
    const double inside = 1.0 - 2.0 * probability(-cut_off);
    variation_ /= std::sqrt(1.0 - 2.0 * cut_off * density(cut_off) / inside);
  }
}

double UnitMean::operator()(double z) const {
  switch (distribution_) {
    case Distribution::normal: return 1.0 + variation_ * cut(z);
    case Distribution::lognormal: return std::exp(shape_ * z - 0.5 * shape_ * shape_);
    default: {
      // The smaller one of both probabilities has all digits.
      const double hazard = z < 0.0 ? -std::log1p(-probability(z)) : -std::log(probability(-z));
      return std::pow(hazard, 1.0 / shape_) / std::tgamma(1.0 + 1.0 / shape_);
    }
  }
}

std::vector<double> normal_field(const RandomField& field, std::span<const double> positions,
                                 int dim, std::span<const Index> first,
                                 std::span<const Index> second) {
  const std::size_t points = positions.size() / static_cast<std::size_t>(dim);
  std::vector<double> cosine(points), sine(points), values(first.size(), 0.0);
  Numbers numbers(field.seed);
  for (int w = 0; w < waves; ++w) {
    // The spectrum of exp(-(r/l)^2) is normal with the deviation sqrt(2) / l along each axis.
    std::array<double, 3> wave;
    for (double& along : wave) {
      along = numbers.normal() * std::numbers::sqrt2 / field.correlation_length;
    }
    const double amplitude = numbers.amplitude(), phase = numbers.phase();
    // The phase in the middle is the sum of half the phases of both points.
    for (std::size_t i = 0; i < points; ++i) {
      double sum = phase;
      for (int a = 0; a < dim; ++a) sum += wave[a] * positions[i * dim + a];
      cosine[i] = std::cos(0.5 * sum);
      sine[i] = std::sin(0.5 * sum);
    }
    for (std::size_t b = 0; b < values.size(); ++b) {
      const Index i = first[b], j = second[b];
      values[b] += amplitude * (cosine[i] * cosine[j] - sine[i] * sine[j]);
    }
  }
  for (double& value : values) value /= std::sqrt(static_cast<double>(waves));
  return values;
}

}  // namespace perilink
