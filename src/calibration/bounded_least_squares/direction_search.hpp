#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

namespace perilink {

/// Least size of vectors that threads share, and the number of their parts.
constexpr std::size_t long_vector = 80000, parts_of_vectors = 8;

/// Calls visit(part, begin, end), at the same time for the parts of long vectors.
template <class Visit>
void for_each_part_of(std::size_t size, Visit visit) {
  const std::size_t parts = size > long_vector ? parts_of_vectors : 1;
#pragma omp parallel for schedule(static) if (parts > 1)
  for (std::size_t part = 0; part < parts; ++part) {
    visit(part, part * size / parts, (part + 1) * size / parts);
  }
}

/// Returns a'b, with one order of sums for any number of threads.
inline double dot(const std::vector<double>& a, const std::vector<double>& b) {
  // A single sum would take four cycles per number, because each addition depends on the last.
  constexpr std::size_t lanes = 8;
  double sums[parts_of_vectors] = {};
  for_each_part_of(a.size(), [&](std::size_t part, std::size_t k, std::size_t end) {
    double lane[lanes] = {};
    for (; a.size() > long_vector && k + lanes <= end; k += lanes) {
      for (std::size_t l = 0; l < lanes; ++l) lane[l] += a[k + l] * b[k + l];
    }
    double sum = 0.0;
    for (const double own : lane) sum += own;
    for (; k < end; ++k) sum += a[k] * b[k];
    sums[part] = sum;
  });
  double sum = 0.0;
  for (const double own : sums) sum += own;
  return sum;
}

/// a = b + factor * c
inline void combine(std::vector<double>& a, const std::vector<double>& b, double factor,
                    const std::vector<double>& c) {
  for_each_part_of(a.size(), [&](std::size_t, std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) a[k] = b[k] + factor * c[k];
  });
}

inline double norm(const std::vector<double>& a) { return std::sqrt(dot(a, a)); }

/// Round-off of the residual over the norm of the multipliers (a tenth of an ulp, measured on
/// strips of up to 60 000 particles). Multipliers of long waves along thin bodies reach 1e9.
/// Iterations below this limit only change round-off.
constexpr double round_off = 2e-17;

/// State of a solution by conjugate gradients.
struct DirectionSearch {
  const std::vector<double>& right;
  double target;  ///< required norm of the residual
  std::vector<double> residual, direction;
  int iterations = 0;
  int cheap_iterations = 0;  ///< iterations that may continue below the target
  bool rounded = false;      ///< whether products of the steps have single precision
  /// Whether directions are made conjugate to all former directions (FormerDirections).
  bool keeps_directions = false;

  static constexpr double cheap_reduction = 0.1;
  /// Products of single precision are used until residuals have fallen by the first factor, and
  /// abandoned where the fall is less than the second.
  static constexpr double digits_of_steps = 1e-4, least_gain = 0.1;
};

/// Map of a vector, called as map(vector, result).
using VectorMap = std::function<void(const std::vector<double>&, std::vector<double>&)>;

/// Iterates at most `most` times. Steps with products of single precision compute the exact
/// residual whenever it seems to have fallen by digits_of_steps, and make the next direction
/// conjugate to the last. Where the exact residual has hardly fallen, the iteration continues with
/// exact products.
/// \param exact, product  products with the matrix
/// \return whether the target is reached
bool descend(DirectionSearch& search, int most, const VectorMap& exact, const VectorMap& product,
             const VectorMap& precondition);

}  // namespace perilink
