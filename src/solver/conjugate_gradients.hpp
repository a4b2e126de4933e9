#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <span>
#include <vector>

namespace perilink {

/// Computes result = A x; both have size n.
using LinearMap = std::function<void(std::span<const double> vector, std::span<double> result)>;

/// Computes a'b of two vectors.
using ScalarProduct =
    std::function<double(std::span<const double> first, std::span<const double> second)>;

/// Corrections for products of few digits.
struct Correction {
  /// Replaces the recursive residual by the exact residual of the solution. Empty: no corrections.
  std::function<void(std::span<const double> solution, std::span<double> residual)> find_residual;
  /// Whether later directions stay conjugate to the solution at a correction. This needs fewer
  /// steps where few bonds hold large parts, but loses digits where rigid motions are much larger
  /// than strains.
  bool keeps_solution = true;
};

/// The residual is corrected when the estimated error has fallen by the first factor since the last
/// correction. The solution fails if the true error has not fallen by the second factor.
inline constexpr double digits_between_corrections = 1e-5, least_gain_of_digits = 0.1;

/// Returns a'b, summed in one order.
double scalar_product(std::span<const double> first, std::span<const double> second);

/// Energies gained by the steps of conjugate gradients. The energies of two consecutive windows of
/// steps are assumed to continue as a geometric series. Slower convergence needs longer windows
/// (docs/theory/large_bodies.md, L-2).
class EnergyGains {
 public:
  void add(double gain) { gains_.push_back(gain); }
  bool empty() const { return gains_.empty(); }
  /// Returns the estimated error in the energy norm: square root of the last window's energy plus
  /// the geometric series of later windows. Infinite before there are two windows.
  double error() const {
    const std::size_t window = std::max(shortest, gains_.size() / 8);
    if (gains_.size() < 2 * window) return std::numeric_limits<double>::infinity();
    const auto sum_to = [&](std::size_t end) {
      return std::accumulate(gains_.end() - static_cast<std::ptrdiff_t>(end + window),
                             gains_.end() - static_cast<std::ptrdiff_t>(end), 0.0);
    };
    const double last = sum_to(0), before = sum_to(window);
    const double ratio = before > 0.0 ? std::min(last / before, slowest) : 0.0;
    return std::sqrt(last / (1.0 - ratio));
  }

 private:
  static constexpr std::size_t shortest = 6;
  static constexpr double slowest = 0.999;
  std::vector<double> gains_;
};

/// Result of conjugate gradients.
struct GradientsReport {
  int iterations = 0;
  double energy = 0.0;  ///< x' A x of the correction of the solution
  double error = 0.0;   ///< square root of the missing energy, estimated from above
  /// r'z of the right side over the energy of its solution, an upper bound of the smallest
  /// eigenvalue of the preconditioned A.
  double softest = std::numeric_limits<double>::infinity();
  bool converged = false;
};

/// Largest r'z of a correction that is skipped, over the energy that counts as no error. r'z
/// approximates the energy of the correction.
inline constexpr double negligible_correction = 0.01;

/// Adds the solution x of A x = right to `solution`, by preconditioned conjugate gradients. A is
/// symmetric and positive definite. Each step adds alpha r'z to the energy of x, so the last gains
/// estimate the missing energy (Hestenes & Stiefel 1952; Strakos & Tichy 2002).
/// \param precondition  an approximate A^-1, symmetric and positive definite
/// \param enough        stops when the error is at most this part of the square root of the energy,
///     or of `scale`
/// \param scale         energy of the solution that x corrects; 0: none
/// \param dot           product of whole vectors, if the given vectors are parts of them
/// \param correct       for products of few digits (digits_between_corrections); needs a zero
///     initial solution. Empty: no corrections
/// \param too_soft      stops unconverged when GradientsReport::softest is smaller
/// \throws NotPositiveDefinite if A is not positive definite
GradientsReport conjugate_gradients(const LinearMap& product, const LinearMap& precondition,
                                    std::span<const double> right, std::span<double> solution,
                                    double enough, double scale, int most_iterations,
                                    const ScalarProduct& dot = scalar_product,
                                    const Correction& correct = {}, double too_soft = 0.0);

}  // namespace perilink
