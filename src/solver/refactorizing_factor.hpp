#pragma once

#include <vector>

#include "solver/cholmod_support.hpp"

namespace perilink {

/// Factorises the changed matrix anew at every event: the yardstick for speed and exactness.
class RefactorizingFactor final : public CholmodRoute {
 public:
  void factorize(const SparseMatrix& matrix, std::span<const Index> groups) override;
  void refactorize(const SparseMatrix& matrix) override;
  void follow_load(std::span<const double> load, std::span<double> solution) override;
  double prepare_downdate(const SparseVector& x) override;
  void commit_downdate(double load_change, std::span<double> solution) override;
  /// One factorisation for all of them.
  void downdate(std::span<const SparseVector> x, std::span<const double> load_changes,
                std::span<const double> pivots, std::span<double> solution) override;
  void update(const SparseVector& x, std::span<const double> solution) override;

 private:
  void add_to_load(const SparseVector& x, double factor);
  void change_matrix(const SparseVector& x, double sign);

  SparseMatrix matrix_;
  std::vector<double> load_;
  SparseVector x_;
};

}  // namespace perilink
