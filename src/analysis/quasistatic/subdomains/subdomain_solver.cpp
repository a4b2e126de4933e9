#include "analysis/quasistatic/subdomains/subdomain_solver.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "assembly/subdomains/subdomain_stiffness.hpp"
#include "solver/factor_routes.hpp"
#include "solver/not_positive_definite.hpp"

namespace perilink {
namespace {

/// Returns the particles along an edge of a subdomain. Larger subdomains keep the coarse factor of
/// very large bodies small, for a fifth more iterations. Many solves are worth a larger factor.
double edge_of_subdomain(const Network& network, const SubdomainSolverOptions& options) {
  const Index particles = network.particles.size();
  if (options.edge > 0) return options.edge;
  if (network.dim() == 2) return options.blocks ? 6.0 : 8.0;
  if (options.blocks && particles < 100'000) return 4.0;
  return particles < 2'000'000 ? 6.0 : 8.0;
}

Index particles_of_subdomain(const Network& network, const SubdomainSolverOptions& options) {
  return static_cast<Index>(std::pow(edge_of_subdomain(network, options), network.dim()));
}

double largest_stiffness(const Network& network) {
  const auto largest = std::ranges::max_element(network.stiffness);
  return largest == network.stiffness.end() || *largest <= 0.0 ? 1.0 : *largest;
}

}  // namespace

SubdomainSolver::SubdomainSolver(const Network& network, const Unknowns& unknowns, Secants secants,
                                 const SubdomainSolverOptions& options,
                                 const std::vector<double>* ground)
    : network_(network),
      unknowns_(unknowns),
      secants_(secants),
      options_(options),
      motions_(network, secants, unknowns, particles_of_subdomain(network, options)),
      ground_(ground),
      factor_(make_factor(options.blocks ? FactorRoute::refactorize : FactorRoute::in_place, 1)),
      motion_(unknowns.number.size(), 0.0) {
  expect_nothing_embedded(unknowns);
  SubdomainStiffness stiffness = assemble_subdomain_stiffness(network, secants, unknowns, motions_);
  if (ground != nullptr && !ground->empty()) {
    add_springs(stiffness, unknowns, motions_, *ground);
  }
  if (!stiffness.invert_blocks(unknowns.width)) {
    throw NotPositiveDefinite("the stiffness of a particle is not positive definite");
  }
  blocks_ = std::move(stiffness.blocks);
  const int motions = motions_.num_motions();
  coarse_.resize(static_cast<std::size_t>(num_subdomains()) * motions);
  std::vector<Index> groups;
  for (Index b = 0; b < num_subdomains(); ++b) groups.insert(groups.end(), motions, b);
  factor_->factorize(stiffness.coarse, groups);
  if (can_be_shared(network, unknowns, options.ranks)) {
    stiffness.blocks = blocks_;
    team_ = std::make_unique<Team>(*options.ranks, network, unknowns, secants, motions_, stiffness,
                                   ground);
  }
  if (!team_ && SingleBody::is_made_of(network)) pack();
  require_resistance();
}

void SubdomainSolver::pack() {
  order_.emplace(motions_, network_.particles.size());
  packed_ = std::make_unique<PackedBonds>(network_, secants_, order_->place,
                                          largest_stiffness(network_), order_->part_end());
  packed_motion_.resize(order_->place.size() * PackedBonds::row_size(network_.dim()));
  packed_forces_.resize(packed_motion_.size());
  if (!options_.blocks) return;
  single_ = std::make_unique<SingleBody>(network_, unknowns_, motions_, *order_, *packed_, blocks_,
                                         *factor_);
}

SolverError SubdomainSolver::not_there(int iterations, double error, double tolerance) {
  return SolverError(fmt::format(
      "conjugate gradients stopped after {} iterations with an error of {:.1e}, above the "
      "tolerance {:.0e}: parts of the body are weakly connected, or the tolerance is below "
      "round-off; set solver = \"direct\"",
      iterations, error, tolerance));
}

/// Checks resistance with random forces, since the loads may not excite a free motion. With the
/// preconditioner the smallest eigenvalue of whole bodies is 0.1 to 1. It is 1e-3 if a body's last
/// bonds hold, and below 1e-16 for a mechanism. Bonds in single precision resist a mechanism
/// slightly, so the network checks small eigenvalues again.
void SubdomainSolver::require_resistance() {
  constexpr double none = 1e-8, uncertain = 1e-4, enough = 1e-4;
  constexpr int most_steps = 2000;
  std::mt19937 random(7);  // fixed: the same result in every run
  std::vector<double> forces(static_cast<std::size_t>(unknowns_.count)), motion;
  for (double& force : forces) force = static_cast<double>(random() % 2) - 0.5;
  double softest = 0.0;
  const auto look = [&](auto search) {
    motion.assign(forces.size(), 0.0);
    const GradientsReport report = search();
    iterations_ += report.iterations;
    softest = report.softest;
  };
  if (team_) look([&] { return team_->search(forces, motion, enough, 0.0, most_steps); });
  const auto look_by = [&](auto multiply, double too_soft) {
    look(
        [&] { return search_by(multiply, forces, motion, enough, 0.0, most_steps, {}, too_soft); });
  };
  if (packed_) look_by(&SubdomainSolver::multiply_packed, uncertain);
  if (!team_ && softest < uncertain) look_by(&SubdomainSolver::multiply, none);
  if (softest > none) return;
  throw NotPositiveDefinite(
      "the stiffness matrix is singular to working precision: part of the body can move freely");
}

template <class Multiply>
GradientsReport SubdomainSolver::search_by(Multiply multiply, std::span<const double> right,
                                           std::span<double> solution, double enough, double scale,
                                           int most_steps, const Correction& correct,
                                           double too_soft) {
  return conjugate_gradients(
      [&](std::span<const double> q, std::span<double> result) {
        product_threads_.run_within([&] { (this->*multiply)(q, result); });
      },
      [&](std::span<const double> r, std::span<double> z) {
        inverse_threads_.run_within([&] { precondition(r, z); });
      },
      right, solution, enough, scale, most_steps, scalar_product, correct, too_soft);
}

/// Solves from zero; the network continues if rounded bonds do not converge.
GradientsReport SubdomainSolver::search(std::span<const double> right, std::span<double> solution,
                                        double enough, double scale, int most_steps) {
  if (team_) return team_->search(right, solution, enough, scale, most_steps);
  if (!packed_) {
    return search_by(&SubdomainSolver::multiply, right, solution, enough, scale, most_steps);
  }
  const GradientsReport rounded = search_packed(right, solution, enough, scale, most_steps);
  if (rounded.converged) return rounded;
  packed_.reset();
  single_.reset();
  std::vector<double> left(right.size());
  find_residual(right, solution, left);
  GradientsReport report = search_by(&SubdomainSolver::multiply, left, solution, enough,
                                     std::max(scale, rounded.energy), most_steps);
  report.iterations += rounded.iterations;
  report.energy += rounded.energy;
  return report;
}

/// Computes residual = right - K solution.
void SubdomainSolver::find_residual(std::span<const double> right, std::span<const double> solution,
                                    std::span<double> residual) {
  multiply(solution, residual);
  for (std::size_t k = 0; k < residual.size(); ++k) residual[k] = right[k] - residual[k];
}

/// Iterates with bonds in single precision; the network computes the residuals.
GradientsReport SubdomainSolver::search_packed(std::span<const double> right,
                                               std::span<double> solution, double enough,
                                               double scale, int most_steps) {
  packed_->follow(secants_);
  try {
    return search_by(&SubdomainSolver::multiply_packed, right, solution, enough, scale, most_steps,
                     {[&](std::span<const double> found, std::span<double> residual) {
                        find_residual(right, found, residual);
                      },
                      !options_.blocks});  // events need all digits
  } catch (const NotPositiveDefinite&) {
    std::ranges::fill(solution, 0.0);
    return {};  // double precision decides
  }
}

void SubdomainSolver::precondition(std::span<const double> residual, std::span<double> result) {
  const int width = unknowns_.width;
#pragma omp parallel for schedule(static) if (network_.particles.size() > many_particles)
  for (Index p = 0; p < network_.particles.size(); ++p) {
    const double* block = blocks_.data() + static_cast<std::size_t>(p) * width * width;
    for (int a = 0; a < width; ++a) {
      if (unknowns_.at(p, a) < 0) continue;
      double sum = 0.0;
      for (int b = 0; b < width; ++b) {
        if (unknowns_.at(p, b) >= 0) sum += block[a * width + b] * residual[unknowns_.at(p, b)];
      }
      result[unknowns_.at(p, a)] = sum;
    }
  }
  motions_.restrict(residual, coarse_);
  factor_->solve(coarse_, coarse_);
  motions_.add(coarse_, result);
}

/// Computes result = K q.
void SubdomainSolver::multiply(std::span<const double> q, std::span<double> result) {
  const std::vector<Index>& number = unknowns_.number;
  for (std::size_t slot = 0; slot < number.size(); ++slot) {
    if (number[slot] >= 0) motion_[slot] = q[number[slot]];
  }
  internal_force(network_, secants_, motion_, forces_);
  for (std::size_t slot = 0; slot < number.size(); ++slot) {
    if (number[slot] >= 0) result[number[slot]] = forces_.forces[slot];
  }
  if (ground_ == nullptr) return;
  for (std::size_t k = 0; k < ground_->size(); ++k) result[k] += (*ground_)[k] * q[k];
}

/// Computes result = K q by packed bonds.
void SubdomainSolver::multiply_packed(std::span<const double> q, std::span<double> result) {
  const auto width = static_cast<std::size_t>(unknowns_.width);
  const std::size_t row = PackedBonds::row_size(unknowns_.width);
  const auto for_each_unknown = [&](auto visit) {
    for (Index p = 0; p < network_.particles.size(); ++p) {
      const std::size_t slot = p * width, place = packed_->place(p) * row;
      for (std::size_t a = 0; a < width; ++a) {
        const Index unknown = unknowns_.number[slot + a];
        if (unknown >= 0) visit(slot + a, place + a, unknown);
      }
    }
  };
  for_each_unknown([&](std::size_t, std::size_t place, Index k) { packed_motion_[place] = q[k]; });
  packed_->forces(packed_motion_, packed_forces_);
  for_each_unknown([&](std::size_t slot, std::size_t place, Index k) {
    result[k] = packed_->unit() * packed_forces_[place];
    if (!network_.support_stiffness.empty()) result[k] += network_.support_stiffness[slot] * q[k];
    if (ground_ != nullptr && !ground_->empty()) result[k] += (*ground_)[k] * q[k];
  });
}

void SubdomainSolver::solve(std::span<const double> right, std::span<double> solution) {
  const std::vector<double> wanted(right.begin(), right.end());
  std::fill(solution.begin(), solution.end(), 0.0);
  const double tolerance = options_.tolerance * (options_.blocks ? finer : 1.0);
  const GradientsReport report =
      search(wanted, solution, tolerance, options_.blocks ? 0.0 : energy_, most_iterations);
  iterations_ += report.iterations;
  energy_ = options_.blocks ? report.energy : std::max(energy_, report.energy);
  error_ = energy_ > 0.0 ? report.error / std::sqrt(energy_) : 0.0;
  if (!report.converged) throw not_there(report.iterations, error_, tolerance);
}

void SubdomainSolver::correct(std::span<const double> right, std::span<double> solution,
                              double energy) {
  const double tolerance = options_.tolerance * finer;
  const std::vector<double> wanted(right.begin(), right.end());
  std::ranges::fill(solution, 0.0);
  const GradientsReport report = search(wanted, solution, tolerance, energy, most_iterations);
  iterations_ += report.iterations;
  if (!report.converged) throw not_there(report.iterations, report.error, tolerance);
}

}  // namespace perilink
