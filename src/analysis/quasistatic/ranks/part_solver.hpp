#pragma once

#include <memory>
#include <span>
#include <vector>

#include "analysis/quasistatic/ranks/body_part.hpp"
#include "assembly/internal_force.hpp"
#include "solver/factor.hpp"

namespace perilink {

/// The part of a rank in conjugate gradients with boxes (docs/theory/large_bodies.md). All ranks
/// have a factor of the boxes, small beside their parts.
class PartSolver {
 public:
  /// \throws SolverError where the boxes' matrix is not positive definite, on all ranks
  PartSolver(Ranks& ranks, BodyPart part);

  /// Collective. Vectors are those of the part.
  GradientsReport search(std::span<const double> right, std::span<double> solution, double enough,
                         double scale, int most_iterations);

  std::size_t size() const { return static_cast<std::size_t>(part_.unknowns.count); }
  FactorStatistics coarse() const { return factor_->statistics(); }

 private:
  void multiply(std::span<const double> q, std::span<double> result);
  void precondition(std::span<const double> residual, std::span<double> result);

  Ranks& ranks_;
  BodyPart part_;
  std::unique_ptr<Factor> factor_;
  std::unique_ptr<GhostLayer> layer_;
  std::vector<double> motion_;  ///< shape (owned + ghosts, width), zero where it is prescribed
  std::vector<double> coarse_;  ///< residual or motion of the boxes, shape (boxes, motions)
  InternalForce forces_;
};

}  // namespace perilink
