#pragma once

#include <Eigen/Dense>
#include <memory>
#include <optional>
#include <vector>

#include "analysis/quasistatic/subdomains/subdomain_solver.hpp"
#include "base/vector_span.hpp"
#include "network/network.hpp"
#include "solver/factor.hpp"

namespace perilink {

/// Returns the capacity of the column cache for this number of displacement components.
std::size_t columns_of_window(std::size_t components, const SubdomainSolverOptions& options = {});

/// Factor-free events (docs/theory/large_bodies.md, section 4): conjugate gradients replace the
/// factor. A cache holds columns K^-1 e. The e are vectors of elements near their events or, if
/// elements carry moments, of unknowns there. Woodbury updates combine the columns after elements
/// have failed. An event costs one pass over the columns if its vector is cached, or acts on cached
/// unknowns only.
class SubdomainFactor final : public Factor {
 public:
  SubdomainFactor(const Network& network, const SubdomainSolverOptions& options);

  /// Starts anew. All arguments are kept by reference: products use the present secants.
  /// \param ground  stiffness of ground springs per unknown, or empty
  /// \throws NotPositiveDefinite if a part of the body can move without resistance
  void begin(const Unknowns& unknowns, Secants secants, const std::vector<double>& ground);

  /// Returns whether K^-1 x is in the cache.
  bool holds(const SparseVector& x) const { return parts_of(x).has_value(); }
  /// Loads the columns of these vectors into the cache. Must precede a change of the secants: a
  /// later downdate would take the change twice.
  void hold(std::span<const SparseVector> x);
  /// Sets vectors that are expected to be needed next, in that order. They are loaded where
  /// blocks have room.
  void expect(std::vector<SparseVector> x) { expected_ = std::move(x); }
  /// Replaces a residual by K^-1 residual, as accurate as a solution of this energy.
  void correct(std::vector<double>& residual, double energy);
  /// Replaces a residual by K^-1 residual after elements have lost stiffness, and clears the cache.
  /// The accuracy is as in correct(). The subdomains are made anew if the number of iterations has
  /// grown much.
  void follow(std::vector<double>& residual, double energy);
  /// Clears the cache, for example after too many changes. Columns are then solved for on request.
  void clear();

  void factorize(const SparseMatrix& matrix, std::span<const Index> groups) override;
  void refactorize(const SparseMatrix& matrix) override;
  void solve(std::span<const double> rhs, std::span<double> solution) override;
  std::vector<double> columns(std::span<const SparseVector> x) override;
  void compliance(std::span<const SparseVector> x, std::span<double> result) override;
  void downdate(std::span<const SparseVector> x, std::span<const double> load_changes,
                std::span<const double> pivots, std::span<double> solution) override;
  void update(const SparseVector& x) override;
  FactorStatistics statistics() const override;

  std::size_t num_blocks() const { return blocks_.size(); }
  Index columns_solved() const { return columns_solved_; }

 private:
  using Part = VectorSpan::Part;  ///< by positions in the cache
  std::optional<std::vector<Part>> parts_of(const SparseVector& x) const;
  void keep_latest();
  SubdomainSolver& solver();
  std::vector<SparseVector> missing_of(std::span<const SparseVector> x) const;
  std::vector<SparseVector> choose(const std::vector<SparseVector>& missing) const;
  void put_in_window(const SparseVector& x, int used);
  void take_in(std::span<const SparseVector> x);
  void fill_right_sides(std::span<const SparseVector> x);
  Eigen::MatrixXd on_columns(std::span<const SparseVector> x, std::size_t block) const;
  Eigen::VectorXd in_window(const SparseVector& x);
  std::vector<double> motion_of(const Eigen::VectorXd& weights) const;
  void change(const Eigen::VectorXd& d, double pivot, double sign);

  const Network& network_;
  SubdomainSolverOptions options_;
  const Unknowns* unknowns_ = nullptr;
  Secants secants_;
  const std::vector<double>* ground_ = nullptr;
  std::unique_ptr<SubdomainSolver> solver_;
  int all_iterations_ = 0;        ///< iterations of all calls of follow()
  int following_iterations_ = 0;  ///< iterations of the first follow() with the present subdomains
  int first_iterations_ = 0;      ///< iterations of the first block with the present subdomains
  std::vector<std::size_t> slot_of_;  ///< Unknowns::slots()
  std::vector<SparseVector> expected_;
  std::vector<SparseVector> window_;  ///< vectors e of cached columns
  std::size_t most_columns_ = 0;      ///< largest number of cached columns so far
  /// Per unknown: position of its unit vector in the cache, or no_index.
  std::vector<Index> place_of_;
  VectorSpan span_;        ///< span of the cached vectors
  std::vector<int> used_;  ///< per position: last event that used it
  int now_ = 0;            ///< events and calls so far
  /// Columns of K^-1 at the time of their solve, block after block, each of shape (particles,
  /// width, block_width).
  std::vector<BlockVector<double>> blocks_;
  BlockVector<double> right_;   ///< right sides of a block, in the shape of blocks_
  Eigen::MatrixXd shares_;      ///< F: the present columns are the blocks times F
  Eigen::MatrixXd compliance_;  ///< H: e' K^-1 e of the present columns
  int begun_ = 0;
  Index columns_solved_ = 0;
};

}  // namespace perilink
