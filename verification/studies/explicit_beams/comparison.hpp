#pragma once

#include <string>
#include <vector>

#include "analysis/dynamics/bonds/runs/dynamic_relaxation.hpp"
#include "specimens.hpp"

namespace perilink::verification {

/// A specimen at rest, by either mode.
struct Solution {
  double deflection = 0.0;           ///< [m]
  std::vector<double> displacement;  ///< shape (particles, 3) [m]
  double seconds = 0.0;
  Index iterations = 0;
  Termination termination = Termination::completed;
};

/// By a factor of the stiffness matrix.
Solution solve(const Specimen& specimen);

/// By explicit steps.
Solution relax(const Specimen& specimen, Strain strain, double tolerance, int threads);

/// Largest difference of two displacements over the largest of the second.
double largest_difference(const Solution& a, const Solution& b);

/// Largest deviation of the deflections of a beam, over the largest of them, from Bernoulli's, over
/// the largest of those: how the paper measures.
double normalized_shape_error(const Specimen& specimen, const Solution& solution);

/// Deflection of the plate of linear elements as their size goes to zero: Richardson's
/// extrapolation from cells of the study's size and of two thirds of it, of order two [m].
double plate_reference();

}  // namespace perilink::verification
