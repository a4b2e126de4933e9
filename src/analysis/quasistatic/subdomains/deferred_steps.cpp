// Steps that the solution of a BoxFactor waits for, and solutions that follow batches.

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "analysis/quasistatic/subdomains/subdomain_factor.hpp"

namespace perilink {

/// solution += blocks times weights, now or when it is asked for.
void SubdomainFactor::move(const Eigen::VectorXd& weights, std::span<double> solution) {
  if (!deferred_) {
    const std::vector<double> motion = motion_of(weights);
    for (std::size_t k = 0; k < motion.size(); ++k) solution[k] += motion[k];
    return;
  }
  deferred_->steps.resize(static_cast<std::size_t>(weights.size()), 0.0);
  deferred_->moved.resize(static_cast<std::size_t>(weights.size()), 0.0);
  for (Eigen::Index k = 0; k < weights.size(); ++k) {
    deferred_->steps[k] += weights[k];
    deferred_->moved[k] += std::abs(weights[k]);
  }
  ++deferred_->changes;
}

DeferredMotion& SubdomainFactor::defer() {
  deferred_.emplace();
  deferred_->unknowns = unknowns_;
  deferred_->blocks = &blocks_;
  return *deferred_;
}

void SubdomainFactor::defer_no_more() {
  if (is_behind()) throw std::logic_error("steps that a solution lacks are given up");
  deferred_.reset();
}

void SubdomainFactor::catch_up(std::span<double> solution) {
  if (!is_behind()) return;
  add_steps(solution);
  std::ranges::fill(deferred_->steps, 0.0);
}

void SubdomainFactor::add_steps(std::span<double> solution) const {
  const std::vector<double> motion = motion_of(std::span<const double>(deferred_->steps));
  for (std::size_t k = 0; k < motion.size(); ++k) solution[k] += motion[k];
}

/// extensions() of the solution with the steps that it lacks.
std::vector<double> SubdomainFactor::present_extensions(std::span<const SparseVector> x,
                                                        std::span<const double> load_changes,
                                                        std::span<const double> solution) const {
  std::vector<double> result = extensions(x, load_changes, solution);
  for (std::size_t a = 0; is_behind() && a < x.size(); ++a) {
    for (int k = 0; k < x[a].size(); ++k) {
      const std::size_t slot = slot_of_[x[a].rows[k]];
      result[a] += x[a].values[k] * deferred_->steps_at(slot, 1)[0];
    }
  }
  return result;
}

void SubdomainFactor::follow(std::vector<double>& residual, double energy) {
  constexpr double many_more = 1.5;
  if (!window_.empty()) forget();
  const int before = solver_->iterations();
  correct(residual, energy);
  const int iterations = solver_->iterations() - before;
  all_iterations_ += iterations;
  if (following_iterations_ == 0) following_iterations_ = iterations;
  if (iterations <= many_more * following_iterations_) return;
  make_solver();
  following_iterations_ = 0;
  ++begun_;
}

}  // namespace perilink
