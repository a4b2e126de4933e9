#include "analysis/quasistatic/equilibrium/update/factor_update.hpp"

#include <algorithm>

#include "analysis/quasistatic/equilibrium/update/mechanism.hpp"
#include "base/error.hpp"
#include "base/rare_branch.hpp"
#include "solver/conjugate_gradients.hpp"

namespace perilink {
namespace {

/// Rates of one core, to choose the cheapest way: factorisation, pass through a factor larger than
/// the caches, change by one vector, change by many vectors.
constexpr double factor_flops = 15e9, factor_bytes = 20e9, change_bytes = 36e9, change_flops = 20e9;
/// Per element: time to assemble the stiffness for a batch or for contact states, and to find the
/// forces of a motion.
constexpr double seconds_to_assemble = 3e-7, seconds_for_sides = 1e-7, seconds_per_force = 1e-8;

/// Time of a solve for forces on the elements of a batch over that of a solve for all forces [-].
constexpr double share_of_solution = 0.7;

/// Steps of conjugate gradients that are expected before the first batch.
constexpr int expected_steps = 12;

/// Relative error of conjugate gradients in the energy norm.
constexpr double enough = 1e-11;

}  // namespace

FactorStatistics FactorUpdate::statistics() const {
  FactorStatistics statistics = factor_->statistics();
  statistics.iterations += gradient_steps_;
  return statistics;
}

void FactorUpdate::be_new() {
  lags_ = false;
  missed_savings_ = 0.0;
}

void FactorUpdate::begin(bool resists) {
  be_new();
  const Unknowns& unknowns = body_.unknowns();
  if (resists) return factor_->factorize(body_.stiffness(), unknowns.owners());
  const auto forces_of = [&](std::span<const double> u) {
    return internal_force(body_.network(), body_.secants(), u);
  };
  factorize_stiffness(*factor_, body_.stiffness(), unknowns, &body_.network(), forces_of);
}

void FactorUpdate::renew() {
  factor_->refactorize(body_.stiffness());
  be_new();
}

void FactorUpdate::correct(std::vector<double>& residual, double /*energy*/) {
  factor_->solve(residual, residual);
}

bool FactorUpdate::search(std::vector<double>& residual, std::span<double> solution, double energy,
                          LoadSet kind) {
  lags_ = true;
  const int steps = gradients(residual, solution, energy);
  gradient_steps_ += steps;
  if (kind == LoadSet::growing) last_steps_ = steps;
  return steps > 0;
}

void FactorUpdate::solve_roughly(std::vector<double>& load, double energy) {
  std::vector<double> motion(load.size(), 0.0);
  if (!lags_) {
    factor_->solve(load, motion);
  } else if (gradients(load, motion, energy * rough * rough / (enough * enough)) == 0) {
    throw SolverError("conjugate gradients with an older factor do not converge");
  }
  load = std::move(motion);
}

/// Chooses by counted work, so that the machine's load and the number of threads do not matter.
Way FactorUpdate::cheapest_way(double path) {
  if (take_rare_branch("lagging factor")) return Way::search;
  if (take_rare_branch("renewed factor")) return Way::renew;
  const FactorStatistics factor = factor_->statistics();
  const auto elements = static_cast<double>(body_.network().num_elements());
  const double solution = 2.0 * factor.bytes / factor_bytes;
  const double anew = factor.flops / factor_flops + seconds_to_assemble * elements + solution;
  const int steps = last_steps_ > 0 ? last_steps_ : expected_steps;
  const double search = steps * (solution + seconds_per_force * elements);
  const double change = 4.0 * path / change_flops + share_of_solution * solution;
  if (!lags_ && change <= std::min(anew, search)) return Way::change;
  // A new factor is made once changes of it would have saved as much time as it takes.
  if (lags_) missed_savings_ += std::max(0.0, search - change);
  return missed_savings_ + search < anew ? Way::search : Way::renew;
}

bool FactorUpdate::is_cheaper_anew(std::size_t changes) const {
  const FactorStatistics factor = factor_->statistics();
  const double anew = factor.flops / factor_flops +
                      seconds_for_sides * static_cast<double>(body_.network().num_elements());
  return static_cast<double>(changes) * factor.bytes / change_bytes > anew ||
         take_rare_branch("new factor for sides");
}

/// Corrects a solution by conjugate gradients. The older factor is close to K, so that r'z is
/// nearly the energy of the error.
/// \param residual  residual of the solution; overwritten
/// \param energy    u'K u of the solution
/// \return number of steps; zero if they do not converge
int FactorUpdate::gradients(std::vector<double>& residual, std::span<double> solution,
                            double energy) {
  constexpr int most_steps = 60;
  std::vector<double> z(residual.size()), p(residual.size(), 0.0), q(residual.size());
  double before = 1.0;
  for (int step = 0; step < most_steps; ++step) {
    factor_->solve(residual, z);
    const double rz = scalar_product(residual, z);
    if (!(rz > enough * enough * energy)) return rz >= 0.0 ? step + 1 : 0;
    for (std::size_t k = 0; k < p.size(); ++k) p[k] = z[k] + (step > 0 ? rz / before : 0.0) * p[k];
    body_.multiply(p, q);
    const double curvature = scalar_product(p, q);
    if (!(curvature > 0.0)) return 0;
    for (std::size_t k = 0; k < p.size(); ++k) {
      solution[k] += rz / curvature * p[k];
      residual[k] -= rz / curvature * q[k];
    }
    before = rz;
  }
  return 0;
}

}  // namespace perilink
