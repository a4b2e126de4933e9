#include "analysis/quasistatic/elastic_analysis.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numeric>
#include <tuple>

#include "analysis/quasistatic/equilibrium/equilibrium.hpp"
#include "analysis/quasistatic/equilibrium/update/mechanism.hpp"
#include "assembly/internal_force.hpp"
#include "assembly/stiffness.hpp"
#include "base/dense/decompositions.hpp"
#include "base/error.hpp"
#include "base/timer.hpp"
#include "network/rigid_modes.hpp"
#include "solver/factor_routes.hpp"

namespace perilink {
namespace {

/// Energy imbalance over the work above which an answer is mostly round-off [-].
constexpr double lost_solution = 1e-2;

/// Energies below this fraction of the sum of |load times displacement| are squared round-off. The
/// body then moves as a whole, without stress.
constexpr double no_energy = 1e-24;

/// Subtracts the rigid-body motion that fits the displacements of the supports best.
void take_settlement(const Network& network, const Unknowns& unknowns,
                     std::vector<double>& displacement) {
  Fragment whole;
  whole.particles.resize(static_cast<std::size_t>(network.particles.size()));
  std::iota(whole.particles.begin(), whole.particles.end(), 0);
  const std::vector<std::vector<double>> motions =
      free_motions(network, whole, std::vector<std::uint8_t>(displacement.size(), 0));
  const auto count = static_cast<Eigen::Index>(motions.size());
  Eigen::MatrixXd products = Eigen::MatrixXd::Zero(count, count);
  Eigen::VectorXd parts = Eigen::VectorXd::Zero(count);
  const auto width = static_cast<std::size_t>(unknowns.width);
  for (std::size_t k = 0; k < displacement.size(); ++k) {
    const bool is_rotation = k % width >= static_cast<std::size_t>(network.dim());
    if (unknowns.number[k] >= 0 || is_rotation) continue;
    for (Eigen::Index m = 0; m < count; ++m) {
      parts[m] += motions[m][k] * displacement[k];
      for (Eigen::Index n = 0; n < count; ++n) products(m, n) += motions[m][k] * motions[n][k];
    }
  }
  parts = least_squares(products, parts);
  for (Eigen::Index m = 0; m < count; ++m) {
    for (std::size_t k = 0; k < displacement.size(); ++k) {
      displacement[k] -= parts[m] * motions[m][k];
    }
  }
}

/// Returns the work of loads and reactions: the energy plus the work of the residual. Forces in
/// balance do no work on a rigid-body motion of the supports. Round-off in them would, so this
/// motion is subtracted first.
/// \param network  null: rigid-body motions are not subtracted
double work_of(const ElasticResult& result, const Network* network, const Unknowns& unknowns,
               std::span<const double> solution, std::span<const double> load,
               std::span<const double> missing) {
  constexpr double nothing = 1e-9;  // over the energy
  const double energy = result.strain_energy;
  double missed = 0.0, sizes = 0.0;
  for (std::size_t k = 0; k < solution.size(); ++k) {
    missed += solution[k] * missing[k];
    sizes += std::abs(solution[k] * load[k]);
  }
  if (energy <= no_energy * sizes) return energy;
  const auto is_not_zero = [](double value) { return value != 0.0; };
  const bool settles =
      std::any_of(unknowns.prescribed.begin(), unknowns.prescribed.end(), is_not_zero);
  if (settles && std::abs(missed) > nothing * energy && network != nullptr && !unknowns.carries()) {
    std::vector<double> motion = result.displacement;
    take_settlement(*network, unknowns, motion);
    motion = unknowns.restrict(motion);
    missed = std::inner_product(motion.begin(), motion.end(), missing.begin(), 0.0);
  }
  return energy + 0.5 * missed;
}

void refuse_lost_balance(const ElasticResult& result) {
  const double error = std::abs(result.work - result.strain_energy);
  if (error <= lost_solution * std::abs(result.work)) return;
  throw SolverError(fmt::format(
      "work and energy are out of balance by {:.2g} of the work: the body, or its support, is so "
      "compliant that round-off hides the equilibrium{}",
      error / std::abs(result.work),
      result.subdomains > 0 ? ""
                            : "; conjugate gradients (solver = \"iterative\") lose fewer digits"));
}

/// Solves for the displacements and refines them once.
/// \param network  null: there are no bonds
/// \param prepare  returns the solver of K x = f as solve(f, x), where f and x may be the same
///                 memory
template <class Prepare>
ElasticResult solve_elastic(const Network* network, const Unknowns& unknowns, const Loads& loads,
                            Prepare prepare, const InternalForceOf& internal_of) {
  ElasticResult result;
  Timer timer;
  const std::vector<double> load = right_hand_side(unknowns, loads, internal_of);
  result.seconds.assembly = timer.seconds();
  const auto solve = prepare(result);

  timer.restart();
  std::vector<double> solution(load.size());
  solve(load, solution);
  double load_norm = 0.0;
  for (const double value : load) load_norm += value * value;
  for (int pass = 0; pass < 2; ++pass) {
    result.displacement = unknowns.expand(solution);
    InternalForce internal = internal_of(result.displacement);
    std::vector<double> missing(loads.forces.size());
    for (std::size_t slot = 0; slot < missing.size(); ++slot) {
      missing[slot] = loads.forces[slot] - internal.forces[slot];
    }
    std::vector<double> residual = unknowns.restrict(missing);
    double square = 0.0;
    for (const double value : residual) square += value * value;
    result.strain_energy = internal.energy;
    result.residual = load_norm > 0.0 ? std::sqrt(square / load_norm) : std::sqrt(square);
    if (pass == 1) {
      result.forces = std::move(internal.forces);
      result.work = work_of(result, network, unknowns, solution, load, residual);
      break;
    }
    solve(residual, residual);
    for (std::size_t k = 0; k < solution.size(); ++k) solution[k] += residual[k];
  }
  result.seconds.solve = timer.seconds();
  refuse_lost_balance(result);
  return result;
}

/// Makes a solver from the factor of the matrix that assemble() returns.
template <class Assemble>
auto by_factor(const Unknowns& unknowns, const Network* network, int threads, Assemble assemble,
               const InternalForceOf& internal_of) {
  return [=, &unknowns, &internal_of](ElasticResult& result) {
    Timer timer;
    const SparseMatrix stiffness = assemble();
    result.seconds.assembly += timer.seconds();
    timer.restart();
    const std::shared_ptr<Factor> factor = make_factor(FactorRoute::in_place, threads);
    factorize_stiffness(*factor, stiffness, unknowns, network, internal_of);
    result.seconds.factorization = timer.seconds();
    result.factor = factor->statistics();
    return [factor](std::span<const double> right, std::span<double> solution) {
      factor->solve(right, solution);
    };
  };
}

/// Makes a solver by conjugate gradients.
/// \param make  returns the SubdomainSolver as a shared_ptr
template <class Make>
auto by_subdomains(Make make) {
  return [make](ElasticResult& result) {
    const Timer timer;
    const std::shared_ptr<SubdomainSolver> solver = make();
    result.seconds.factorization += timer.seconds();
    result.factor = solver->coarse();
    result.factor.factorizations = 0;  // the stiffness is not factorised
    result.subdomains = solver->num_subdomains();
    result.factor.ranks = solver->num_ranks();
    return [solver, &result](std::span<const double> right, std::span<double> solution) {
      solver->solve(right, solution);
      result.iterations = solver->iterations();
      result.error = solver->error();
    };
  };
}

}  // namespace

bool is_for_subdomains(const LoadedNetwork& problem, LinearSolver solver, const Ranks* ranks) {
  if (solver != LinearSolver::automatic) return solver == LinearSolver::iterative;
  if (can_be_shared(problem.network, problem.unknowns, ranks)) return true;
  const bool is_mid_surface = problem.network.dim() == 2 || problem.network.shell;
  return !problem.unknowns.carries() && problem.unknowns.count > (is_mid_surface ? 20000 : 3000);
}

std::pair<std::vector<double>, std::vector<double>> find_closed_cracks(
    const LoadedNetwork& problem, const ElasticOptions& options) {
  if (!problem.sets.empty()) {  // runs by stages begin without loads, with closed cracks
    LoadedNetwork first = problem;
    first.sets.clear();
    return find_closed_cracks(first, options);
  }
  EquilibriumOptions settling;
  settling.threads = options.threads;
  settling.subdomains = options.subdomains;
  if (is_for_subdomains(problem, options.solver, options.subdomains.ranks)) {
    settling.solver = LinearSolver::iterative;
  }
  const Equilibrium settled(problem, settling);
  const Secants secants = settled.secants();
  std::pair<std::vector<double>, std::vector<double>> result{{secants.begin(), secants.end()}, {}};
  for (Index e = 0; e < problem.network.num_elements(); ++e) {
    result.second.push_back(secants.axial(e));
  }
  return result;
}

ElasticResult run_elastic_analysis(const LoadedNetwork& problem, const ElasticOptions& options) {
  const Network& network = problem.network;
  const Unknowns& unknowns = problem.unknowns;
  std::pair<std::vector<double>, std::vector<double>> closed;
  if (network.num_contacts > 0) closed = find_closed_cracks(problem, options);
  const Secants secants(closed.first, closed.second);
  const InternalForceOf internal_of = [&](std::span<const double> u) {
    return internal_force(network, secants, u);
  };
  const auto solve = [&](auto prepare) {
    return solve_elastic(&network, unknowns, problem.loads, prepare, internal_of);
  };
  ElasticResult result =
      is_for_subdomains(problem, options.solver, options.subdomains.ranks)
          ? solve(by_subdomains([&] {
              return std::make_shared<SubdomainSolver>(network, unknowns, secants,
                                                       options.subdomains);
            }))
          : solve(by_factor(
                unknowns, &network, options.threads,
                [&] { return assemble_stiffness(network, secants, unknowns); }, internal_of));
  std::tie(result.secants, result.axial) = std::move(closed);
  return result;
}

ElasticResult run_elastic_analysis(const LinearElements& elements, const Unknowns& unknowns,
                                   const Loads& loads, int threads) {
  const InternalForceOf internal_of = [&](std::span<const double> u) {
    return internal_force(elements, u);
  };
  const auto assemble = [&] { return assemble_stiffness(elements, unknowns); };
  return solve_elastic(nullptr, unknowns, loads,
                       by_factor(unknowns, nullptr, threads, assemble, internal_of), internal_of);
}

}  // namespace perilink
