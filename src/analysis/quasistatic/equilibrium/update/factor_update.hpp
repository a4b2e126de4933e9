#pragma once

#include <memory>

#include "analysis/quasistatic/equilibrium/update/update.hpp"
#include "solver/factor_routes.hpp"

namespace perilink {

/// A factor of K that is changed, made anew, or kept as a preconditioner, whichever costs least.
class FactorUpdate : public Update {
 public:
  /// \param threads     see make_factor()
  /// \param in_batches  elements may fail together
  FactorUpdate(const DamagedBody& body, FactorRoute route, int threads, bool in_batches)
      : Update(body), factor_(make_factor(route, threads)), in_batches_(in_batches) {}

  Factor& inverse() override { return *factor_; }
  FactorStatistics statistics() const override;
  void begin(bool resists) override;
  void renew() override;
  void correct(std::vector<double>& residual, double energy) override;
  bool search(std::vector<double>& residual, std::span<double> solution, double energy,
              LoadSet kind) override;
  void solve_roughly(std::vector<double>& load, double energy) override;
  bool searches() const override { return lags_; }
  Way cheapest_way(double path) override;
  bool is_cheaper_anew(std::size_t changes) const override;
  bool adds_solutions() const override { return in_batches_; }
  bool can_follow_a_part() const override { return true; }

 private:
  int gradients(std::vector<double>& residual, std::span<double> solution, double energy);
  void be_new();

  std::unique_ptr<Factor> factor_;
  bool in_batches_;
  int gradient_steps_ = 0;  ///< steps of conjugate gradients in all batches
  int last_steps_ = 0;      ///< steps of the last search for growing loads
  /// Savings that changes of an up-to-date factor would have brought [time].
  double missed_savings_ = 0.0;
};

}  // namespace perilink
