#pragma once

#include <vector>

#include "solver/cholmod_support.hpp"

namespace perilink {

/// Reference for tests of the in-place factor: CHOLMOD's simplicial update and downdate (Davis &
/// Hager 1999, 2009). Forward solutions of a bond's vectors follow their path. One backward
/// substitution with the changed factor gives the displacements.
class CholmodUpdownFactor final : public CholmodRoute {
 public:
  explicit CholmodUpdownFactor(int threads);
  ~CholmodUpdownFactor() override;

  void factorize(const SparseMatrix& matrix, std::span<const Index> groups) override;
  void refactorize(const SparseMatrix& matrix) override;
  std::vector<double> columns(std::span<const SparseVector> x) override;
  void compliance(std::span<const SparseVector> x, std::span<double> result) override;
  void downdate(std::span<const SparseVector> x, std::span<const double> load_changes,
                std::span<const double> pivots, std::span<double> solution) override;
  void update(const SparseVector& x) override;

 private:
  void change(bool add, const SparseVector& x);
  std::vector<double> forward(const SparseVector& x);

  CholmodFactorPtr symbolic_;  ///< supernodal analysis, reused by refactorize(); factor_ is
                               ///< simplicial
  std::vector<Index> position_;
  cholmod_dense* solved_ = nullptr;
  cholmod_sparse* solved_set_ = nullptr;
  cholmod_dense* workspace_y_ = nullptr;
  cholmod_dense* workspace_e_ = nullptr;
};

}  // namespace perilink
