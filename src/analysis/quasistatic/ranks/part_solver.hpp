#pragma once

#include <array>
#include <memory>
#include <span>
#include <vector>

#include "analysis/ranks/body_part.hpp"
#include "assembly/internal_force.hpp"
#include "assembly/subdomains/subdomain_stiffness.hpp"
#include "base/parcel.hpp"
#include "solver/blocks/block_gradients.hpp"
#include "solver/factor.hpp"

namespace perilink {

/// Changes of a body since its parts were sent.
struct BodyChanges {
  std::vector<Index> elements;       ///< numbers in the whole body, ascending
  std::vector<double> axial, other;  ///< new secants of these elements
  std::vector<double> ground;        ///< stiffness of ground springs per unknown; empty: unchanged

  void pack(Parcel& parcel) const;
  static BodyChanges unpack(Parcel& parcel);
};

/// A part of a body with its rows of the two-level preconditioner.
struct PreconditionedPart {
  BodyPart part;  ///< unknowns of the own particles only, with numbers of the part
  std::vector<double> axial, other;  ///< secant stiffness ratios of the elements
  std::vector<double> blocks;     ///< inverse stiffness of each own particle, (owned, width, width)
  SparseMatrix coarse;            ///< P'K P of the whole body, lower triangle
  std::vector<Index> subdomains;  ///< per own particle
  std::vector<std::array<double, 6>> rows;  ///< rows of P, shape (owned, width)
  int motions = 3;                          ///< number of rigid-body motions of a subdomain
  bool changes = false;                     ///< secants change, and search_block() is called

  Secants secants() const { return {other, axial}; }
  void pack(Parcel& parcel) const;
  static PreconditionedPart unpack(Parcel& parcel);
};

/// \param stiffness  stiffness of the whole body, its blocks inverted
PreconditionedPart cut_part(const Network& network, Secants secants, const Unknowns& unknowns,
                            const SubdomainMotions& motions, const SubdomainStiffness& stiffness,
                            const Partition& partition, int rank);

/// Conjugate gradients of one rank with the two-level preconditioner (docs/theory/large_bodies.md).
/// Every rank has a factor of the coarse matrix, which is small compared with the parts.
class PartSolver {
 public:
  /// \throws SolverError on all ranks where the coarse matrix is not positive definite
  PartSolver(Ranks& ranks, PreconditionedPart part);

  /// Applies changes of the whole body to the elements and ground springs of this part.
  void follow(const BodyChanges& changes);

  /// Collective: solves with conjugate_gradients(). Vectors have the unknowns of the part.
  GradientsReport search(std::span<const double> right, std::span<double> solution, double enough,
                         double scale, int most_iterations);

  /// Collective: solves with block_conjugate_gradients(). Vectors have shape (owned, width,
  /// block_width) and are zero at prescribed components.
  GradientsReport search_block(std::span<double> right, std::span<double> solution,
                               const BlockRow& sizes, double enough, int most_iterations);

 private:
  const Unknowns& unknowns() const { return own_.part.body.unknowns; }
  /// First own component in fields of the part, shape (particles, width).
  std::size_t first_slot() const {
    return static_cast<std::size_t>(own_.part.own_begin) * unknowns().width;
  }
  /// Returns `map` with exceptions that end all ranks, because other ranks wait for this one.
  template <class Map>
  auto guarded(Map map);
  void multiply(std::span<const double> q, std::span<double> result);
  void precondition(std::span<const double> residual, std::span<double> result);
  void multiply_block(std::span<const double> motions, std::span<double> results);
  void precondition_block(std::span<const double> residuals, std::span<double> results);
  void solve_coarse_block();

  Ranks& ranks_;
  PreconditionedPart own_;
  std::vector<double> ground_;  ///< stiffness of ground springs of the own unknowns, or empty
  std::unique_ptr<Factor> factor_;
  GhostLayer layer_;
  std::vector<double> motion_;  ///< shape (particles, width), zero where prescribed
  std::vector<double> coarse_;  ///< residual or motion of subdomains, shape (subdomains, motions)
  InternalForce forces_;

  // The fields above for block_width vectors at once.
  std::vector<double> motions_, block_forces_, coarse_sums_, coarse_columns_;
};

}  // namespace perilink
