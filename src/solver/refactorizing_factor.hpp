#pragma once

#include "solver/cholmod_support.hpp"

namespace perilink {

/// Factor that is recomputed from the changed matrix at every event, as a standard of speed and
/// exactness.
class RefactorizingFactor final : public CholmodRoute {
 public:
  explicit RefactorizingFactor(int threads) : CholmodRoute(threads) {}

  void factorize(const SparseMatrix& matrix, std::span<const Index> groups) override;
  void refactorize(const SparseMatrix& matrix) override;
  /// Needs one factorisation for all vectors.
  void downdate(std::span<const SparseVector> x, std::span<const double> load_changes,
                std::span<const double> pivots, std::span<double> solution) override;
  void update(const SparseVector& x) override;

 private:
  void change_matrix(const SparseVector& x, double sign);

  SparseMatrix matrix_;
};

}  // namespace perilink
