#pragma once

#include <functional>
#include <limits>
#include <span>

namespace perilink {

/// result = A x, both of size n.
using LinearMap = std::function<void(std::span<const double> vector, std::span<double> result)>;

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

/// Adds to `solution` the x of A x = right by preconditioned conjugate gradients, A symmetric and
/// positive definite. Each step adds alpha r'z to the energy of x, so that what the last steps have
/// added tells what is missing (Hestenes & Stiefel 1952; Strakos & Tichy 2002).
/// \param precondition  an approximate A^-1, symmetric and positive definite
/// \param enough        stops where the error is no larger than this part of the square root of the
///                      energy, or of `scale`
/// \param scale         energy of a solution that this one corrects; 0: none
/// \throws NotPositiveDefinite where A is not
GradientsReport conjugate_gradients(const LinearMap& product, const LinearMap& precondition,
                                    std::span<const double> right, std::span<double> solution,
                                    double enough, double scale, int most_iterations);

}  // namespace perilink
