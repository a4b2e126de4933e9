#pragma once

#include <memory>
#include <span>
#include <vector>

#include "analysis/quasistatic/ranks/body_part.hpp"
#include "assembly/internal_force.hpp"
#include "base/parcel.hpp"
#include "solver/blocks/block_gradients.hpp"
#include "solver/factor.hpp"

namespace perilink {

/// What has become of a body since its parts were told last.
struct BodyChanges {
  std::vector<GlobalIndex> elements;  ///< with other secants than before, ascending
  std::vector<double> axial, other;   ///< what these are now
  std::vector<double> ground;  ///< springs that hold unknowns; empty: those that are known already

  void pack(Parcel& parcel) const;
  static BodyChanges unpack(Parcel& parcel);
};

/// The part of a rank in conjugate gradients with boxes (docs/theory/large_bodies.md). All ranks
/// have a factor of the boxes, small beside their parts.
class PartSolver {
 public:
  /// \throws SolverError where the boxes' matrix is not positive definite, on all ranks
  PartSolver(Ranks& ranks, BodyPart part);

  /// Elements of the whole body, of which this part has some; springs of its own unknowns.
  void follow(const BodyChanges& changes);

  /// Collective. Vectors are those of the part.
  GradientsReport search(std::span<const double> right, std::span<double> solution, double enough,
                         double scale, int most_iterations);

  /// Collective: block_conjugate_gradients() of vectors of shape (owned, width, block_width), zero
  /// where something is held.
  GradientsReport search_block(std::span<double> right, std::span<double> solution,
                               const BlockRow& sizes, double enough, int most_iterations);

  /// Collective. What internal_force() finds, of the own particles, and the energy of the elements
  /// whose first end is one of them.
  /// \param motion  that of the own particles, shape (owned, width)
  InternalForce internal(std::span<const double> motion);

  const BodyPart& part() const { return part_; }
  /// What internal() was asked for last, and the same of ghosts; shape (owned + ghosts, width).
  std::span<const double> last_motion() const { return last_motion_; }

  std::size_t size() const { return static_cast<std::size_t>(part_.unknowns.count); }
  FactorStatistics coarse() const { return factor_->statistics(); }
  Index num_subdomains() const { return static_cast<Index>(coarse_.size()) / part_.motions; }

 private:
  void multiply(std::span<const double> q, std::span<double> result);
  void precondition(std::span<const double> residual, std::span<double> result);
  void multiply_block(std::span<const double> motions, std::span<double> results);
  void precondition_block(std::span<const double> residuals, std::span<double> results);
  void solve_coarse_block();

  Ranks& ranks_;
  BodyPart part_;
  std::vector<double> ground_;  ///< springs of the own unknowns, or empty
  std::unique_ptr<Factor> factor_;
  GhostLayer layer_;
  std::vector<double> motion_;  ///< shape (owned + ghosts, width), zero where it is prescribed
  std::vector<double> coarse_;  ///< residual or motion of the boxes, shape (boxes, motions)
  InternalForce forces_;
  std::vector<double> last_motion_;

  // Each number of the above block_width times.
  std::vector<double> motions_, block_forces_, coarse_sums_, coarse_columns_;
};

}  // namespace perilink
