#pragma once

#include <memory>

#include "calibration/bounded_least_squares/coarse_space.hpp"
#include "calibration/bounded_least_squares/equations_factor.hpp"
#include "calibration/bounded_least_squares/symmetry_reduced/reduced_factor.hpp"

namespace perilink {

/// Preconditioner of one problem, kept for the next problem with equal points and similar
/// coefficients.
struct KeptPreconditioner {
  std::unique_ptr<CoarseSpace> boxes;
  std::unique_ptr<EquationsFactor> factor;
  std::unique_ptr<ReducedFactor> reduced;
  IndependentRows independent_rows;

  void reset() { *this = {}; }
};

}  // namespace perilink
