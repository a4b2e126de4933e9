#pragma once

#include <vector>

#include "solver/cholmod_support.hpp"

namespace perilink {

/// CHOLMOD's own simplicial update and downdate (Davis & Hager 1999, 2009): the reference that the
/// tests hold the in-place factor against. The forward solution of the load is changed together
/// with the factor (updown_solve); one backward substitution per event gives the displacement, so
/// nothing here rests on the Sherman–Morrison formula.
class CholmodUpdownFactor final : public CholmodRoute {
 public:
  CholmodUpdownFactor();
  ~CholmodUpdownFactor() override;

  void factorize(const SparseMatrix& matrix, std::span<const Index> groups) override;
  void refactorize(const SparseMatrix& matrix) override;
  void follow_load(std::span<const double> load, std::span<double> solution) override;
  double prepare_downdate(const SparseVector& x) override;
  void commit_downdate(double load_change, std::span<double> solution) override;
  void update(const SparseVector& x, std::span<const double> solution) override;

 private:
  void change(bool add, const SparseVector& x, double load_change);
  void backward(std::span<double> solution);

  CholmodFactorPtr symbolic_;  ///< supernodal, used again by refactorize; factor_ is simplicial
  std::vector<Index> position_;
  SparseVector x_;
  std::vector<double> forward_;  ///< L^-1 P f of the load that is followed
  cholmod_dense* solved_ = nullptr;
  cholmod_sparse* solved_set_ = nullptr;
  cholmod_dense* workspace_y_ = nullptr;
  cholmod_dense* workspace_e_ = nullptr;
};

}  // namespace perilink
