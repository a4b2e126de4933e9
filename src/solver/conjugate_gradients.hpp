#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <span>
#include <vector>

namespace perilink {

/// result = A x, both of size n.
using LinearMap = std::function<void(std::span<const double> vector, std::span<double> result)>;

/// a'b of two vectors.
using ScalarProduct =
    std::function<double(std::span<const double> first, std::span<const double> second)>;

/// For products of few digits.
struct Correction {
  /// Puts the residual of a solution in place of what is left of it by the steps so far. Empty:
  /// never.
  std::function<void(std::span<const double> solution, std::span<double> residual)> find_residual;
  /// Whether later directions are conjugate to the solution at a correction, too: fewer steps where
  /// parts hang on a few bonds, and fewer digits where bodies move far beside what strains them.
  bool keeps_solution = true;
};

/// Corrections of searches whose product has fewer digits than their answer is to have come
/// whenever errors seem to have fallen by the first factor. Where they have not by the second one,
/// the search ends without an answer.
inline constexpr double digits_between_corrections = 1e-5, least_gain_of_digits = 0.1;

/// Sum over the numbers in one order.
double scalar_product(std::span<const double> first, std::span<const double> second);

/// What the steps of conjugate gradients have brought. Energies of two windows of steps one after
/// the other fall by a factor, and go on to. The slower the search, the longer the windows have to
/// be (docs/theory/large_bodies.md, L-2).
class EnergyGains {
 public:
  void add(double gain) { gains_.push_back(gain); }
  bool empty() const { return gains_.empty(); }
  /// Square root of the energy that was missing before the last window: its own and what a
  /// geometric series of windows adds behind it. Infinite before there are two.
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

/// How a search by conjugate gradients went.
struct GradientsReport {
  int iterations = 0;
  double energy = 0.0;  ///< x' A x of what was added to the solution
  double error = 0.0;   ///< square root of the energy that is missing, estimated from above
  /// r'z of the right side over the energy of its solution: no less than the smallest eigenvalue of
  /// the preconditioned A.
  double softest = std::numeric_limits<double>::infinity();
  bool converged = false;
};

/// A correction whose r'z, near the energy of its error, is no more than this part of the energy
/// that counts as no error, is not looked for.
inline constexpr double negligible_correction = 0.01;

/// Adds to `solution` the x of A x = right by preconditioned conjugate gradients, A symmetric and
/// positive definite. Each step adds alpha r'z to the energy of x, so that what the last steps have
/// added tells what is missing (Hestenes & Stiefel 1952; Strakos & Tichy 2002).
/// \param precondition  an approximate A^-1, symmetric and positive definite
/// \param enough        stops where the error is no larger than this part of the square root of the
///                      energy, or of `scale`
/// \param scale         energy of a solution that this one corrects; 0: none
/// \param dot           that of whole vectors, where those here are parts of them
/// \param correct       where the product has few digits, see digits_between_corrections; the
///                      solution must be zero at first. Empty: never
/// \param too_soft      ends without an answer where A is known to be softer somewhere, see
///                      GradientsReport::softest
/// \throws NotPositiveDefinite where A is not
GradientsReport conjugate_gradients(const LinearMap& product, const LinearMap& precondition,
                                    std::span<const double> right, std::span<double> solution,
                                    double enough, double scale, int most_iterations,
                                    const ScalarProduct& dot = scalar_product,
                                    const Correction& correct = {}, double too_soft = 0.0);

}  // namespace perilink
