#include "analysis/quasistatic/elastic_analysis.hpp"

#include <cmath>

#include "assembly/internal_force.hpp"
#include "assembly/stiffness.hpp"
#include "base/timer.hpp"
#include "solver/factor_routes.hpp"

namespace perilink {
namespace {

/// \param assemble     gives K
template <class Assemble>
ElasticResult solve_elastic(const Unknowns& unknowns, const Loads& loads, int threads,
                            Assemble assemble, const InternalForceOf& internal_of) {
  ElasticResult result;
  Timer timer;
  const SparseMatrix stiffness = assemble();
  const std::vector<double> load = right_hand_side(unknowns, loads, internal_of);
  result.seconds.assembly = timer.seconds();

  timer.restart();
  const std::unique_ptr<Factor> factor = make_factor(FactorRoute::in_place, threads);
  factor->factorize(stiffness, unknowns.owners());
  result.seconds.factorization = timer.seconds();

  timer.restart();
  std::vector<double> solution(load.size());
  factor->solve(load, solution);
  double load_norm = 0.0;
  for (const double value : load) load_norm += value * value;
  for (int pass = 0; pass < 2; ++pass) {
    result.displacement = unknowns.expand(solution);
    const InternalForce internal = internal_of(result.displacement);
    std::vector<double> missing(loads.forces.size());
    for (std::size_t slot = 0; slot < missing.size(); ++slot) {
      missing[slot] = loads.forces[slot] - internal.forces[slot];
    }
    std::vector<double> residual = unknowns.restrict(missing);
    double square = 0.0;
    for (const double value : residual) square += value * value;
    result.strain_energy = internal.energy;
    result.residual = load_norm > 0.0 ? std::sqrt(square / load_norm) : std::sqrt(square);
    if (pass == 1) break;
    factor->solve(residual, residual);
    for (std::size_t k = 0; k < solution.size(); ++k) solution[k] += residual[k];
  }
  result.factor = factor->statistics();
  result.seconds.solve = timer.seconds();
  return result;
}

}  // namespace

ElasticResult run_elastic_analysis(const LoadedNetwork& problem, int threads) {
  const Network& network = problem.network;
  const std::vector<double> secants(static_cast<std::size_t>(network.num_elements()), 1.0);
  return solve_elastic(
      problem.unknowns, problem.loads, threads,
      [&] { return assemble_stiffness(network, secants, problem.unknowns); },
      [&](std::span<const double> u) { return internal_force(network, secants, u); });
}

ElasticResult run_elastic_analysis(const LinearElements& elements, const Unknowns& unknowns,
                                   const Loads& loads, int threads) {
  return solve_elastic(
      unknowns, loads, threads, [&] { return assemble_stiffness(elements, unknowns); },
      [&](std::span<const double> u) { return internal_force(elements, u); });
}

}  // namespace perilink
