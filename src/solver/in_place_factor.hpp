#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "base/thread_choice.hpp"
#include "solver/cholmod_support.hpp"
#include "solver/factor.hpp"
#include "solver/supernodes/supernodes.hpp"

namespace perilink {

/// Factor L D L' on CHOLMOD's supernodal pattern, changed in place. A downdate never adds entries,
/// so the dense blocks stay. CHOLMOD's own update would convert them to a slower simplicial factor.
///
/// Each event needs one forward elimination of x along one path of the elimination tree. The
/// unknowns of a bond are mutually coupled, so one path contains them all. The pivot and the
/// downdate share this elimination. One backward pass gives K^-1 x and the new solution (Sherman &
/// Morrison), and changes the columns of the path.
class InPlaceFactor final : public Factor {
 public:
  explicit InPlaceFactor(int threads);

  void factorize(const SparseMatrix& matrix, std::span<const Index> groups) override;
  void refactorize(const SparseMatrix& matrix) override;
  void solve(std::span<const double> rhs, std::span<double> solution) override;
  void keep_current(std::span<const std::uint8_t> wanted) override;
  /// Eliminates along each path, with one backward pass for all vectors.
  std::vector<double> columns(std::span<const SparseVector> x) override;
  double pivot(const SparseVector& x) override;
  void compliance(std::span<const SparseVector> x, std::span<double> result) override;
  void downdate(std::span<const SparseVector> x, std::span<const double> load_changes,
                std::span<const double> pivots, std::span<double> solution) override;
  /// Needs one pass over the joined paths of up to most_together vectors.
  double downdate_together(std::span<const SparseVector> x) override;
  double path_of(std::span<const SparseVector> x) const override;
  /// Eliminates along the paths of the rows, with one backward pass.
  void add_solution(const SparseVector& b, std::span<double> solution) override;
  void update(const SparseVector& x) override;
  FactorStatistics statistics() const override;

 private:
  Supernode<double> block(Index supernode) const { return supernode_of(*factor_, supernode); }
  Index num_supernodes() const { return static_cast<Index>(factor_->nsuper); }

  void adopt_pattern();
  void turn_into_ldl();
  void forward_on(Index supernode, Index start, double* vector, double* local) const;
  void backward_on(Index supernode, double* vector, double* local) const;
  void backward_and_change_on(Index supernode, double* vector, double* local);
  /// Runs `on_supernode(supernode, local)` from the roots to the leaves.
  template <typename Function>
  void descend(ThreadChoice& choice, const Function& on_supernode);
  bool is_wanted(Index supernode) const { return wanted_.empty() || wanted_[supernode]; }
  void forward_path(const SparseVector& permuted, std::optional<Index> start = std::nullopt);
  void downdate_one(const SparseVector& x, double load_change, double pivot,
                    std::span<double> solution);
  void change_path(const SparseVector& permuted, double sign);
  void clear_path();
  void add_to_path(Index column);
  double change_together(std::span<const SparseVector> permuted);
  void start_change(double sign);

  int threads_;
  ThreadChoice solution_threads_, column_threads_, change_threads_;
  CholmodSession session_;
  CholmodFactorPtr factor_;
  Index size_ = 0;
  int factorizations_ = 0;
  double flops_ = 0.0;  ///< operations of one factorisation

  std::vector<Index> position_;  ///< per unknown: position in the factor's order
  SupernodeTree tree_;
  SupernodeTree::Cut cut_;
  Index longest_ = 0;  ///< largest number of rows of a supernode

  std::vector<double> vector_;  ///< work vector, in the factor's order
  std::vector<double> local_;   ///< rows of a supernode, two parts per thread
  SparseVector on_path_of_;     ///< the x, in the factor's order, with p_ = L^-1 x; empty: none
  std::vector<Index> path_;     ///< supernodes of the path, ascending
  std::vector<std::uint8_t> on_path_;  ///< per supernode
  std::vector<std::uint8_t> wanted_;   ///< supernodes computed by backward passes; empty: all
  std::vector<double> p_;              ///< L^-1 x along the path, in the factor's order
  std::vector<double> beta_;           ///< per column of the path
  std::vector<double> w_;              ///< x reduced by its eliminations, along the path
  /// Changes by several vectors: remainder of each vector, shape (vectors, n), and the vectors at
  /// each supernode, one bit each. Both are zero between changes.
  std::vector<double> together_;
  std::vector<std::uint32_t> at_supernode_;
  std::vector<double> to_root_;  ///< per supernode: numbers of L from it to the root
};

}  // namespace perilink
