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

/// Columns that a window keeps, at most, in a body of so many components of displacement.
std::size_t columns_of_window(std::size_t components, const SubdomainSolverOptions& options = {});

/// What a factor does for events, by conjugate gradients (docs/theory/large_bodies.md, section 4):
/// a window of columns K^-1 e, the e vectors of elements that are near their events or, where
/// elements carry moments, of unknowns there; and how the columns combine since elements have
/// failed. An event whose vector is one of them, or acts on unknowns that are all in the window,
/// costs one pass over the columns.
class SubdomainFactor final : public Factor {
 public:
  SubdomainFactor(const Network& network, const SubdomainSolverOptions& options);

  /// Begins anew. All of it is kept by reference: products are those of the secants as they are.
  /// \param ground  springs that hold unknowns, or empty
  /// \throws NotPositiveDefinite where a part of the body can move without resistance
  void begin(const Unknowns& unknowns, Secants secants, const std::vector<double>& ground);

  /// Whether K^-1 of this vector is at hand.
  bool holds(const SparseVector& x) const { return parts_of(x).has_value(); }
  /// From now on it is, of these vectors. Called before the secants change: a downdate by vectors
  /// that are not held would take the change twice.
  void hold(std::span<const SparseVector> x) { hold(x, nullptr); }
  /// The same where they are not held; with their columns a solution is corrected.
  /// \param residual  goes over to K^-1 residual, as exact as a solution of this energy is to be
  /// \return whether it has: blocks may have no room for it
  bool hold_and_correct(std::span<const SparseVector> x, std::vector<double>& residual,
                        double energy);
  /// Vectors that are likely to be asked for next, the likeliest first: they go into the window
  /// where blocks have room beside what is asked for.
  void expect(std::vector<SparseVector> x) { expected_ = std::move(x); }
  /// residual <- K^-1 residual, as exact as a solution of this energy is to be.
  void correct(std::vector<double>& residual, double energy);
  /// correct() after elements have lost stiffness; no columns are kept. Boxes are made anew where
  /// it takes many more iterations than with new ones.
  void follow(std::vector<double>& residual, double energy);
  /// Elements of these vectors are gone, and hardly anybody asks for them any more: when the window
  /// is full they go first.
  void let_go(std::span<const SparseVector> x);
  /// Columns at hand have followed too many changes: all are solved for again when they are asked
  /// for.
  void forget();

  void factorize(const SparseMatrix& matrix, std::span<const Index> groups) override;
  void refactorize(const SparseMatrix& matrix) override;
  void solve(std::span<const double> rhs, std::span<double> solution) override;
  std::vector<double> columns(std::span<const SparseVector> x) override;
  void compliance(std::span<const SparseVector> x, std::span<double> result) override;
  void downdate(std::span<const SparseVector> x, std::span<const double> load_changes,
                std::span<const double> pivots, std::span<double> solution) override;
  void update(const SparseVector& x) override;
  int factorizations() const override { return begun_; }
  FactorStatistics statistics() const override;

  std::size_t num_blocks() const { return blocks_.size(); }
  Index columns_solved() const { return columns_solved_; }

 private:
  using Part = VectorSpan::Part;  ///< by places of the window
  std::optional<std::vector<Part>> parts_of(const SparseVector& x) const;
  void keep_latest();
  void make_solver();
  std::vector<SparseVector> missing_of(std::span<const SparseVector> x) const;
  struct Correction {
    std::vector<double>& residual;
    double energy;
    bool is_done = false;
  };
  void hold(std::span<const SparseVector> x, Correction* correction);
  std::vector<SparseVector> choose(const std::vector<SparseVector>& missing,
                                   std::size_t reserved) const;
  void put_in_window(const SparseVector& x, int used);
  void take_in(std::span<const SparseVector> x, Correction* correction);
  void fill_right_sides(std::span<const SparseVector> x, const Correction* correction);
  Eigen::MatrixXd on_columns(std::span<const SparseVector> x, std::size_t block) const;
  void mirror_compliance(Eigen::Index before);
  Eigen::VectorXd in_window(const SparseVector& x);
  std::vector<double> motion_of(const Eigen::VectorXd& weights) const;
  void change(const Eigen::VectorXd& d, double pivot, double sign);

  const Network& network_;
  SubdomainSolverOptions options_;
  const Unknowns* unknowns_ = nullptr;
  Secants secants_;
  const std::vector<double>* ground_ = nullptr;
  std::unique_ptr<SubdomainSolver> solver_;
  int all_iterations_ = 0;            ///< all calls of follow()
  int following_iterations_ = 0;      ///< the first follow() with these boxes took
  int first_iterations_ = 0;          ///< the first block took with these boxes
  std::vector<std::size_t> slot_of_;  ///< Unknowns::slots()
  std::vector<SparseVector> expected_;
  std::vector<SparseVector> window_;  ///< vectors e whose columns are at hand
  std::vector<Index> place_of_;  ///< per unknown: where it is in the window by itself, or no_index
  VectorSpan span_;              ///< what the window makes up
  std::vector<int> used_;        ///< per place: when an event used it last; negative: let go
  int now_ = 0;                  ///< events and calls so far
  /// Columns of K^-1 as it was when they were solved for, block after block, each of shape
  /// (particles, width, block_width).
  std::vector<BlockVector<double>> blocks_;
  BlockVector<double> right_;   ///< right sides of a block, of the same shape
  Eigen::MatrixXd shares_;      ///< F: the present columns are those of the blocks times F
  Eigen::MatrixXd compliance_;  ///< H: e' K^-1 e of the present columns
  int begun_ = 0;
  Index columns_solved_ = 0;
};

}  // namespace perilink
