#pragma once

namespace perilink {

/// Limits of the conjugate gradients of NormalEquations.
struct NormalEquationsLimits {
  /// Least regularisations of the method of multipliers. Singular values of waves along a boundary
  /// fall with the square of their length; a factor allows a smaller regularisation.
  static constexpr double least_regularisation = 1e-10;
  static constexpr double factor_regularisation = 1e-18;
  /// Regularisation of the last steps, smaller for long waves of unstructured particle sets.
  static constexpr double settled_regularisation = 1e-13;
  /// Iterations that take as long as a factor, and iterations after which a factor is stale.
  static constexpr int worth_of_factor = 15, stale_iterations = 40;
  /// Most iterations of a solution without a penalty by a factor of the present active-set weights.
  /// Feasible ones took up to 62, infeasible ones, with a singular matrix, thousands.
  static constexpr int most_by_factor = 200;
  /// Iterations of a solution after which the coarse space is made, or gets other modes.
  /// Near-null-space modes take about 500 iterations of blocks, and are used in several solutions.
  /// With modes of an earlier problem only the coarse system is made.
  static constexpr int patience = 200, patience_with_fields = 100, stale_fields = 200;
  /// Iterations after which the coarse system is made again, which takes about forty iterations.
  static constexpr int stale_coarse = 80;
  /// Iterations that take as long as the blocks.
  static constexpr int cheap_iterations = 10;
};

}  // namespace perilink
