#include "analysis/quasistatic/subdomains/subdomain_factor.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>
#include <stdexcept>
#include <utility>

#include "solver/blocks/block_gradients.hpp"

namespace perilink {
namespace {

/// Pivots below which the cache is cleared.
constexpr double small_pivot = 0.1;

}  // namespace

SubdomainFactor::SubdomainFactor(const Network& network, const SubdomainSolverOptions& options)
    : network_(network), options_(options) {
  options_.blocks = true;
}

void SubdomainFactor::begin(const Unknowns& unknowns, Secants secants,
                            const std::vector<double>& ground) {
  unknowns_ = &unknowns;
  secants_ = secants;
  ground_ = &ground;
  slot_of_ = unknowns.slots();
  ++begun_;
  expected_.clear();
  place_of_.assign(static_cast<std::size_t>(unknowns.count), no_index);
  window_.clear();
  clear();
  solver_.reset();  // frees memory first
  solver();
}

/// Returns the subdomains; makes those of the present body, split along its cracks, if there are
/// none. They are missing if the body did not resist when they were to be made anew.
SubdomainSolver& SubdomainFactor::solver() {
  if (!solver_) {
    solver_ = std::make_unique<SubdomainSolver>(network_, *unknowns_, secants_, options_, ground_);
    first_iterations_ = 0;
  }
  return *solver_;
}

void SubdomainFactor::factorize(const SparseMatrix& /*matrix*/, std::span<const Index> /*groups*/) {
  throw std::logic_error("there is no matrix to factorise, see begin()");
}

void SubdomainFactor::refactorize(const SparseMatrix& /*matrix*/) {
  throw std::logic_error("there is no matrix to factorise, see begin()");
}

void SubdomainFactor::solve(std::span<const double> rhs, std::span<double> solution) {
  solver().solve(rhs, solution);
}

void SubdomainFactor::correct(std::vector<double>& residual, double energy) {
  energy > 0.0 ? solver().correct(residual, residual, energy) : solver().solve(residual, residual);
}

/// Returns the blocks times weights, per unknown.
std::vector<double> SubdomainFactor::motion_of(const Eigen::VectorXd& weights) const {
  std::vector<double> motion(unknowns_->number.size(), 0.0);
  for (std::size_t b = 0; b < blocks_.size(); ++b) {
    const std::span<const double> own(weights.data() + b * block_width, block_width);
    if (std::ranges::all_of(own, [](double weight) { return weight == 0.0; })) continue;
    add_combination(blocks_[b], own, motion);
  }
  std::vector<double> result(slot_of_.size());
  for (std::size_t k = 0; k < result.size(); ++k) result[k] = motion[slot_of_[k]];
  return result;
}

std::vector<double> SubdomainFactor::columns(std::span<const SparseVector> x) {
  hold(x);
  std::vector<double> result;
  for (const SparseVector& column : x) {
    const std::vector<double> motion = motion_of(shares_ * in_window(column));
    result.insert(result.end(), motion.begin(), motion.end());
  }
  return result;
}

void SubdomainFactor::compliance(std::span<const SparseVector> x, std::span<double> result) {
  hold(x);
  std::vector<std::vector<Part>> parts;
  for (const SparseVector& column : x) parts.push_back(parts_of(column).value());
  for (std::size_t a = 0; a < x.size(); ++a) {
    for (std::size_t b = 0; b <= a; ++b) {
      double sum = 0.0;
      for (const auto& [row, first] : parts[a]) {
        for (const auto& [column, second] : parts[b]) {
          sum += first * second * compliance_(row, column);
        }
      }
      result[a * x.size() + b] = result[b * x.size() + a] = sum;
    }
  }
}

/// Changes K^-1 to K^-1 + sign (K^-1 x) (K^-1 x)' / pivot.
void SubdomainFactor::change(const Eigen::VectorXd& d, double pivot, double sign) {
  const Eigen::VectorXd h = compliance_ * d, f = shares_ * d;
  compliance_.noalias() += (sign / pivot) * h * h.transpose();
  shares_.noalias() += (sign / pivot) * f * h.transpose();
}

void SubdomainFactor::downdate(std::span<const SparseVector> x,
                               std::span<const double> load_changes, std::span<const double> pivots,
                               std::span<double> solution) {
  for (const SparseVector& column : x) {
    if (!holds(column)) throw std::logic_error("columns must be solved for before a change");
  }
  if (!solution.empty()) {
    const std::vector<double> shares = extensions(x, load_changes, solution);
    Eigen::VectorXd sum = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(window_.size()));
    for (std::size_t a = 0; a < x.size(); ++a) sum += shares[a] / pivots[a] * in_window(x[a]);
    const std::vector<double> motion = motion_of(shares_ * sum);
    for (std::size_t k = 0; k < motion.size(); ++k) solution[k] += motion[k];
  }
  for (std::size_t a = 0; a < x.size(); ++a) change(in_window(x[a]), pivots[a], 1.0);
  // Errors of columns grow in proportion to the motions.
  if (std::ranges::any_of(pivots, [](double pivot) { return pivot < small_pivot; })) clear();
}

void SubdomainFactor::follow(std::vector<double>& residual, double energy) {
  constexpr double many_more = 1.5;
  if (!window_.empty()) clear();
  const int before = solver().iterations();
  correct(residual, energy);
  const int iterations = solver().iterations() - before;
  all_iterations_ += iterations;
  if (following_iterations_ == 0) following_iterations_ = iterations;
  if (iterations <= many_more * following_iterations_) return;
  solver_.reset();  // frees memory first
  solver();
  following_iterations_ = 0;
  ++begun_;
}

void SubdomainFactor::update(const SparseVector& x) {
  double removed = 0.0;
  compliance({&x, 1}, {&removed, 1});
  change(in_window(x), 1.0 + removed, -1.0);
}

FactorStatistics SubdomainFactor::statistics() const {
  FactorStatistics result;
  result.size = static_cast<Index>(slot_of_.size());
  result.entries = static_cast<double>(slot_of_.size()) * static_cast<double>(window_.size());
  result.bytes = 8.0 * result.entries;
  result.most_bytes = 8.0 * static_cast<double>(slot_of_.size() * most_columns_);
  result.event_bytes = result.bytes;
  // A restart costs two solves: about a hundred products of ten operations per bond.
  result.flops = 1000.0 * static_cast<double>(network_.num_elements());
  result.factorizations = begun_;
  result.iterations = all_iterations_;
  result.ranks = solver_ ? solver_->num_ranks() : 1;
  result.subdomains = solver_ ? solver_->num_subdomains() : 0;
  return result;
}

}  // namespace perilink
