#pragma once

#include "analysis/quasistatic/equilibrium/update/update.hpp"
#include "analysis/quasistatic/subdomains/subdomain_factor.hpp"

namespace perilink {

/// A cache of columns of K^-1, solved for by conjugate gradients (factor-free events).
class ColumnUpdate final : public Update {
 public:
  /// \param in_batches  elements may fail together
  ColumnUpdate(const DamagedBody& body, const SubdomainSolverOptions& options, bool in_batches)
      : Update(body),
        columns_(body.network(), options),
        in_batches_(in_batches),
        tolerance_(options.tolerance) {}

  Factor& inverse() override { return columns_; }
  FactorStatistics statistics() const override { return columns_.statistics(); }
  void begin(bool resists) override;
  void renew() override { begin(true); }
  void correct(std::vector<double>& residual, double energy) override {
    columns_.correct(residual, energy);
  }
  bool search(std::vector<double>& residual, std::span<double> solution, double energy,
              LoadSet kind) override;
  void solve_roughly(std::vector<double>& load, double energy) override;
  bool searches() const override { return in_batches_; }
  Way cheapest_way(double /*path*/) override { return Way::search_only; }
  bool is_cheaper_anew(std::size_t changes) const override;
  bool adds_solutions() const override { return false; }
  bool can_follow_a_part() const override { return false; }
  std::optional<Drift> drift() const override;
  bool is_prepared(Index element) const override;
  void prepare(Index element, std::span<const Index> expected) override;
  void announce(std::span<const SparseVector> x) override { columns_.hold(x); }
  void judge(double error, double energy) override;

 private:
  SubdomainFactor columns_;
  bool in_batches_;
  double tolerance_;  ///< SubdomainSolverOptions::tolerance
};

}  // namespace perilink
