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

/// How far conjugate gradients go, and with which boxes.
struct SubdomainSolverOptions {
  double tolerance = 1e-10;  ///< error over solution, both in the norm of energy
  Index edge = 0;  ///< particles along an edge of a box; 0: as many as serve the body best
  /// Whether solve_block() is wanted; the errors of solve() then count each by its own energy.
  bool blocks = false;
  /// Elements from which on it pays that displacements wait until a search asks for them.
  Index fewest_to_defer = 200'000;
  /// Columns that a BoxFactor keeps where every event adds them up for the whole body; three times
  /// as many, where memory allows, if displacements wait.
  Index window = 256;
  Ranks* ranks = nullptr;  ///< that share the work, where there are several
};

/// Equilibrium without a factor of the stiffness: conjugate gradients on the network itself, with
/// the blocks of the particles and the rigid motions of boxes of them as preconditioner
/// (docs/theory/large_bodies.md). The number of iterations hardly grows with the body.
class SubdomainSolver {
 public:
  /// \param unknowns  nothing may carry particles; kept by reference, as network and secants: the
  ///                  product is that of the secants as they are
  /// \param ground    springs that hold unknowns, size n, or empty: may be filled later; null:
  ///                  there are none, and secants do not change
  /// \throws NotPositiveDefinite where a part of the body can move without resistance
  SubdomainSolver(const Network& network, const Unknowns& unknowns, Secants secants,
                  const SubdomainSolverOptions& options,
                  const std::vector<double>* ground = nullptr);

  /// Both of size n; they may be the same memory. What is solved later may correct what was solved
  /// before: the error counts by the largest energy so far.
  /// \throws SolverError where the iterations do not get there
  void solve(std::span<const double> right, std::span<double> solution);

  /// Many right sides from zero, each by itself; shape (particles, width, block_width), zero where
  /// something is held. Errors count by the energy of a right side where all but the particles that
  /// it acts on stand still: elements see differences between particles, which are small beside
  /// motions of the whole body.
  /// \param right   used up
  /// \param enough  error that each is to have, as the tolerance counts
  /// \param size_of_last  zero, or the energy that the error of the last right side counts by,
  ///                      which is what is left of another solution
  /// \return iterations, and the largest error
  /// \throws SolverError as solve()
  GradientsReport solve_block(std::span<double> right, std::span<double> solution, double enough,
                              double size_of_last = 0.0);

  /// left -= K motions of such a block, by the network in double precision.
  void take_products(std::span<const double> motions, std::span<double> left);

  /// A solution less exact, of what is left of another one.
  /// \param energy  that the error counts by, of the whole solution; positive
  /// \throws SolverError as solve()
  void correct(std::span<const double> right, std::span<double> solution, double energy);

  /// An element holds a small part of the energy: solutions in which events are looked for are
  /// finer by this.
  static constexpr double finer = 1e-3;

  int iterations() const { return iterations_; }  ///< in all solves
  double error() const { return error_; }         ///< the last solve left, as the tolerance counts
  Index num_subdomains() const { return motions_.num_subdomains(); }
  int num_ranks() const { return team_ ? options_.ranks->count() : 1; }
  FactorStatistics coarse() const { return factor_->statistics(); }

 private:
  static constexpr int most_iterations = 20000;
  /// From which on the start of threads takes less than the work.
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
  std::unique_ptr<PackedBonds> packed_;  ///< null: products are those of the network
  std::unique_ptr<SingleBody> single_;   ///< null: blocks are left to double precision
  std::vector<double> coarse_;           // residual or motion of the boxes, shape (boxes, motions)
  std::vector<double> motion_;           // shape (particles, width), zero where it is prescribed
  BlockVector<double> packed_motion_, packed_forces_;  // the same in the order of packed bonds
  BlockVector<double> coarse_block_;
  /// Vectors for search_in_single(), shape (n, block_width), kept for the next block.
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
