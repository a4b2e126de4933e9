#include "analysis/quasistatic/box_solver.hpp"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <random>

#include "base/error.hpp"
#include "solver/factor_routes.hpp"
#include "solver/not_positive_definite.hpp"

namespace perilink {
namespace {

constexpr int most_iterations = 20000;

/// Particles of a box. Where the body is large, larger ones keep the coarse factor small.
Index particles_of_box(const Network& network, const BoxSolverOptions& options) {
  const bool plane = network.dim() == 2;
  const double edge = options.edge > 0                       ? options.edge
                      : network.particles.size() < 1'000'000 ? plane ? 8.0 : 6.0
                                                             : 8.0;
  return static_cast<Index>(plane ? edge * edge : edge * edge * edge);
}

}  // namespace

BoxSolver::BoxSolver(const LoadedNetwork& problem, Secants secants, const BoxSolverOptions& options)
    : problem_(problem),
      secants_(secants),
      options_(options),
      motions_(problem.network, secants, problem.unknowns,
               particles_of_box(problem.network, options)),
      factor_(make_factor(FactorRoute::in_place, 1)),
      motion_(problem.unknowns.number.size(), 0.0) {
  expect_nothing_carried(problem.unknowns);
  BoxStiffness stiffness =
      assemble_box_stiffness(problem.network, secants, problem.unknowns, motions_);
  blocks_ = std::move(stiffness.blocks);
  invert_blocks();
  const int motions = motions_.num_motions();
  coarse_.resize(static_cast<std::size_t>(num_boxes()) * motions);
  std::vector<Index> groups;
  for (Index b = 0; b < num_boxes(); ++b) groups.insert(groups.end(), motions, b);
  factor_->factorize(stiffness.coarse, groups);
  if (options.ranks && can_be_shared(problem.network, problem.unknowns)) {
    stiffness.blocks = blocks_;
    team_ = std::make_unique<Team>(*options.ranks, problem.network, problem.unknowns, secants,
                                   motions_, stiffness);
  }
  require_resistance();
}

/// What moves without resistance shows under forces of any kind; the loads may not stir it. With
/// the boxes as preconditioner the smallest eigenvalue of whole bodies is 0.1 to 1, of a body held
/// by the last of its bonds 1e-3, of a mechanism below 1e-16.
void BoxSolver::require_resistance() {
  constexpr double none = 1e-8, enough = 1e-4;
  constexpr int most_steps = 2000;
  std::mt19937 random(7);  // fixed: the same verdict in every run
  std::vector<double> forces(static_cast<std::size_t>(problem_.unknowns.count));
  for (double& force : forces) force = static_cast<double>(random() % 2) - 0.5;
  std::vector<double> motion(forces.size(), 0.0);
  const GradientsReport report = search(forces, motion, enough, 0.0, most_steps);
  iterations_ += report.iterations;
  if (report.softest > none) return;
  throw NotPositiveDefinite(
      "the stiffness matrix is singular to working precision: part of the body can move freely");
}

GradientsReport BoxSolver::search(std::span<const double> right, std::span<double> solution,
                                  double enough, double scale, int most_steps) {
  if (team_) return team_->search(right, solution, enough, scale, most_steps);
  return conjugate_gradients(
      [&](std::span<const double> q, std::span<double> result) { multiply(q, result); },
      [&](std::span<const double> r, std::span<double> z) { precondition(r, z); }, right, solution,
      enough, scale, most_steps);
}

void BoxSolver::invert_blocks() {
  const int width = problem_.unknowns.width;
  const std::size_t size = static_cast<std::size_t>(width) * width;
  for (std::size_t begin = 0; begin < blocks_.size(); begin += size) {
    Eigen::Map<Eigen::MatrixXd> block(blocks_.data() + begin, width, width);
    const Eigen::LLT<Eigen::MatrixXd> factor(block);
    if (factor.info() != Eigen::Success) {
      throw NotPositiveDefinite("the stiffness of a particle is not positive definite");
    }
    block = factor.solve(Eigen::MatrixXd::Identity(width, width));
  }
}

void BoxSolver::precondition(std::span<const double> residual, std::span<double> result) {
  const Unknowns& unknowns = problem_.unknowns;
  const int width = unknowns.width;
  const double* block = blocks_.data();
  for (Index p = 0; p < problem_.network.particles.size(); ++p, block += width * width) {
    for (int a = 0; a < width; ++a) {
      if (unknowns.at(p, a) < 0) continue;
      double sum = 0.0;
      for (int b = 0; b < width; ++b) {
        if (unknowns.at(p, b) >= 0) sum += block[a * width + b] * residual[unknowns.at(p, b)];
      }
      result[unknowns.at(p, a)] = sum;
    }
  }
  motions_.restrict(residual, coarse_);
  factor_->solve(coarse_, coarse_);
  motions_.add(coarse_, result);
}

/// result = K q
void BoxSolver::multiply(std::span<const double> q, std::span<double> result) {
  const std::vector<Index>& number = problem_.unknowns.number;
  for (std::size_t slot = 0; slot < number.size(); ++slot) {
    if (number[slot] >= 0) motion_[slot] = q[number[slot]];
  }
  internal_force(problem_.network, secants_, motion_, forces_);
  for (std::size_t slot = 0; slot < number.size(); ++slot) {
    if (number[slot] >= 0) result[number[slot]] = forces_.forces[slot];
  }
}

void BoxSolver::solve(std::span<const double> right, std::span<double> solution) {
  const std::vector<double> wanted(right.begin(), right.end());
  std::fill(solution.begin(), solution.end(), 0.0);
  const GradientsReport report =
      search(wanted, solution, options_.tolerance, energy_, most_iterations);
  iterations_ += report.iterations;
  energy_ = std::max(energy_, report.energy);
  error_ = energy_ > 0.0 ? report.error / std::sqrt(energy_) : 0.0;
  if (report.converged) return;
  throw SolverError(fmt::format(
      "conjugate gradients stopped after {} iterations with an error of {:.1e} where {:.0e} was "
      "asked for: parts of the body are held together by very little, or the tolerance is below "
      "what round-off allows; take solver = \"direct\"",
      report.iterations, error_, options_.tolerance));
}

}  // namespace perilink
