#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "analysis/quasistatic/ranks/team.hpp"
#include "analysis/quasistatic/subdomains/single_body.hpp"
#include "assembly/internal_force.hpp"
#include "assembly/subdomains/subdomain_motions.hpp"
#include "base/block.hpp"
#include "base/error.hpp"
#include "base/thread_choice.hpp"
#include "network/network.hpp"
#include "network/unknowns.hpp"
#include "solver/blocks/block_gradients.hpp"
#include "solver/factor.hpp"

namespace perilink {

/// Options of conjugate gradients and their subdomains.
struct SubdomainSolverOptions {
  double tolerance = 1e-10;  ///< relative error in the energy norm
  Index edge = 0;            ///< particles along an edge of a subdomain; 0: chosen for the body
  /// Whether solve_block() is needed. Errors of solve() then scale with the energy of each
  /// solution.
  bool blocks = false;
  /// Largest number of columns in the cache of a SubdomainFactor.
  Index window = 256;
  Ranks* ranks = nullptr;  ///< ranks that share the work, or null
};

/// Finds equilibrium without a factor of the stiffness: conjugate gradients on the network. The
/// two-level preconditioner uses blocks of particles and rigid-body motions of subdomains
/// (docs/theory/large_bodies.md). The number of iterations hardly grows with the body.
class SubdomainSolver {
 public:
  /// \param unknowns  without embedded particles; kept by reference, as network and secants, whose
  ///                  present values define the product
  /// \param ground    stiffness of ground springs per unknown, or empty; may be filled later. Null:
  ///                  there are none, and secants do not change
  /// \throws NotPositiveDefinite if a part of the body can move without resistance
  SubdomainSolver(const Network& network, const Unknowns& unknowns, Secants secants,
                  const SubdomainSolverOptions& options,
                  const std::vector<double>* ground = nullptr);

  /// Both of size n; they may be the same memory. What is solved later may correct what was solved
  /// before: the error counts by the largest energy so far.
  /// \throws SolverError where the iterations do not get there
  void solve(std::span<const double> right, std::span<double> solution);

  /// Solves for block_width right sides from zero, each by itself; shape (particles, width,
  /// block_width), zero where held. The error scales with the energy of a right side if only its
  /// own particles move. Strains depend on differences between particles, which are small compared
  /// with motions of the whole body.
  /// \param right   overwritten
  /// \param enough  requested relative error
  /// \return iterations, and the largest error
  /// \throws SolverError if the iterations do not converge
  GradientsReport solve_block(std::span<double> right, std::span<double> solution, double enough);

  /// Solves for a correction of another solution, less accurately.
  /// \param energy  energy of the whole solution, which scales the error; positive
  /// \throws SolverError if the iterations do not converge
  void correct(std::span<const double> right, std::span<double> solution, double energy);

  /// Factor by which solutions for events are more accurate, since an element holds a small part of
  /// the energy.
  static constexpr double finer = 1e-3;

  int iterations() const { return iterations_; }  ///< in all solves
  double error() const { return error_; }         ///< the last solve left, as the tolerance counts
  Index num_subdomains() const { return motions_.num_subdomains(); }
  int num_ranks() const { return team_ ? options_.ranks->count() : 1; }
  FactorStatistics coarse() const { return factor_->statistics(); }

 private:
  static constexpr int most_iterations = 20000;
  /// Number of particles above which threads pay off.
  static constexpr Index many_particles = 10'000;
  static SolverError not_there(int iterations, double error, double tolerance);
  void precondition(std::span<const double> residual, std::span<double> result);
  void multiply(std::span<const double> q, std::span<double> result);
  void multiply_packed(std::span<const double> q, std::span<double> result);
  template <class Multiply>
  GradientsReport search_by(Multiply multiply, std::span<const double> right,
                            std::span<double> solution, double enough, double scale, int most_steps,
                            const Correction& correct = {}, double too_soft = 0.0);
  GradientsReport search(std::span<const double> right, std::span<double> solution, double enough,
                         double scale, int most_steps);
  void find_residual(std::span<const double> right, std::span<const double> solution,
                     std::span<double> residual);
  GradientsReport search_packed(std::span<const double> right, std::span<double> solution,
                                double enough, double scale, int most_steps);
  GradientsReport search_block(std::span<double> right, std::span<double> solution,
                               const BlockRow& sizes, double enough);
  void pack();
  void require_resistance();
  void precondition_block(std::span<const double> residuals, std::span<double> results);
  void multiply_block(std::span<const double> motions, std::span<double> results);
  bool is_found_in_single(std::span<const double> right, std::span<double> solution,
                          const BlockRow& sizes, double enough, GradientsReport& report);
  GradientsReport search_in_single(std::span<const double> right, std::span<double> solution,
                                   const BlockRow& sizes, double enough);

  const Network& network_;
  const Unknowns& unknowns_;
  Secants secants_;
  SubdomainSolverOptions options_;
  SubdomainMotions motions_;
  std::vector<double> blocks_;  // inverse, shape (particles, width, width)
  const std::vector<double>* ground_ = nullptr;
  std::unique_ptr<Factor> factor_;
  std::unique_ptr<Team> team_;  ///< null: this process works alone
  std::optional<SubdomainOrder> order_;
  std::unique_ptr<PackedBonds> packed_;  ///< null: products use the network
  std::unique_ptr<SingleBody> single_;   ///< null: blocks use double precision
  std::vector<double> coarse_;  // residual or motion of subdomains, shape (subdomains, motions)
  std::vector<double> motion_;  // shape (particles, width), zero where it is prescribed
  BlockVector<double> packed_motion_, packed_forces_;  // in the order of packed bonds
  BlockVector<double> coarse_block_;
  /// Work space of search_in_single(), shape (n, block_width), kept for the next block.
  struct SingleSpace {
    BlockVector<float> found, missing;
    BlockVector<double> residual;
    BlockSpace<float> search;
  } single_space_;
  ThreadChoice product_threads_{omp_get_max_threads()}, inverse_threads_ = product_threads_;
  ThreadChoice block_threads_ = product_threads_;
  InternalForce forces_;
  double energy_ = 0.0, error_ = 0.0;
  int iterations_ = 0;
};

}  // namespace perilink
