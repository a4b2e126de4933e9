#include "drift.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>

#include "analysis/quasistatic/events/single_event_engine.hpp"
#include "assembly/element_vector.hpp"
#include "assembly/internal_force.hpp"
#include "assembly/stiffness.hpp"
#include "solver/factor_routes.hpp"

namespace perilink::verification {
namespace {

double norm(const std::vector<double>& v) {
  return std::sqrt(std::inner_product(v.begin(), v.end(), v.begin(), 0.0));
}

double relative_error(const std::vector<double>& a, const std::vector<double>& b) {
  std::vector<double> difference(a.size());
  for (std::size_t k = 0; k < a.size(); ++k) difference[k] = a[k] - b[k];
  return norm(difference) / norm(b);
}

double residual_of(const Model& model, const std::vector<double>& secants,
                   const std::vector<double>& solution) {
  const InternalForce internal =
      internal_force(model.network, secants, model.unknowns.expand(solution));
  std::vector<double> residual, load;
  for (std::size_t slot = 0; slot < model.unknowns.number.size(); ++slot) {
    if (model.unknowns.number[slot] == no_index) continue;
    load.push_back(model.loads.forces[slot]);
    residual.push_back(model.loads.forces[slot] - internal.forces[slot]);
  }
  return norm(residual) / norm(load);
}

std::vector<double> fresh_solution(const Model& model, const Unknowns& unknowns,
                                   const std::vector<double>& secants) {
  const auto factor = make_factor(FactorRoute::in_place, 1);
  factor->factorize(assemble_stiffness(model.network, secants, unknowns), unknowns.owners());
  const auto load = assemble_right_hand_side(model.network, secants, unknowns, model.loads);
  std::vector<double> solution(load.size());
  factor->solve(load, solution);
  // One step of refinement makes the yardstick better than what it measures.
  const InternalForce internal = internal_force(model.network, secants, unknowns.expand(solution));
  std::vector<double> residual;
  for (std::size_t slot = 0; slot < unknowns.number.size(); ++slot) {
    if (unknowns.number[slot] == no_index) continue;
    residual.push_back(model.loads.forces[slot] - internal.forces[slot]);
  }
  factor->solve(residual, residual);
  for (std::size_t k = 0; k < solution.size(); ++k) solution[k] += residual[k];
  return solution;
}

}  // namespace

std::vector<Drift> measure_drift(const Model& model, int downdates, int interval) {
  std::vector<double> secants(static_cast<std::size_t>(model.network.num_elements()), 1.0);
  const auto factor = make_factor(FactorRoute::in_place, 1);
  factor->factorize(assemble_stiffness(model.network, secants, model.unknowns),
                    model.unknowns.owners());
  const auto load = assemble_right_hand_side(model.network, secants, model.unknowns, model.loads);
  std::vector<double> solution(load.size()), again(load.size());
  factor->solve(load, solution);
  std::mt19937_64 random(12345);
  std::vector<Drift> table;
  int done = 0;
  auto measure = [&] {
    const auto fresh = fresh_solution(model, model.unknowns, secants);
    factor->solve(load, again);
    table.push_back({done, residual_of(model, secants, solution), relative_error(solution, fresh),
                     relative_error(again, fresh)});
  };
  measure();
  while (done < downdates) {
    const Index element = static_cast<Index>(random() % model.network.num_elements());
    if (secants[element] == 0.0) continue;
    const SparseVector x =
        element_vector(model.network, model.unknowns, element, model.network.stiffness[element]);
    const double pivot = factor->pivot(x), load_change = 0.0;
    if (pivot < 1e-2) continue;
    factor->downdate({&x, 1}, {&load_change, 1}, {&pivot, 1}, solution);
    secants[element] = 0.0;
    if (++done % interval == 0) measure();
  }
  return table;
}

Detachment measure_detachment(const Model& model, double x, double y, double radius) {
  const Particles& particles = model.network.particles;
  auto distance = [&](Index i, double px, double py) {
    return std::hypot(particles.position(i)[0] - px, particles.position(i)[1] - py);
  };
  Index centre = 0;
  for (Index i = 1; i < particles.size(); ++i) {
    if (distance(i, x, y) < distance(centre, x, y)) centre = i;
  }
  const auto c = particles.position(centre);
  std::vector<std::uint8_t> inside(static_cast<std::size_t>(particles.size()), 0);
  Detachment result;
  for (Index i = 0; i < particles.size(); ++i) {
    inside[i] = distance(i, c[0], c[1]) <= radius * model.lattice.spacing;
    result.particles += inside[i];
  }
  std::vector<Index> cut;
  std::vector<double> secants(static_cast<std::size_t>(model.network.num_elements()), 1.0);
  for (Index e = 0; e < model.network.num_elements(); ++e) {
    if (inside[model.network.bonds.first[e]] == inside[model.network.bonds.second[e]]) continue;
    cut.push_back(e);
    secants[e] = 0.0;
  }
  result.bonds = static_cast<int>(cut.size());

  SingleEventEngine engine(model, EquilibriumOptions{});
  result.springs = engine.cut(cut);
  const std::span<const double> displacement = engine.displacement();

  // The same body without the part: its unknowns are held, its bonds gone.
  std::vector<std::uint8_t> held(model.unknowns.number.size());
  for (std::size_t slot = 0; slot < held.size(); ++slot) {
    held[slot] = model.unknowns.number[slot] == no_index || inside[slot / 2];
  }
  const Unknowns rest = number_unknowns(2, held, std::vector<double>(held.size(), 0.0));
  const auto expected = rest.expand(fresh_solution(model, rest, secants));
  double difference = 0.0, size = 0.0;
  for (std::size_t slot = 0; slot < held.size(); ++slot) {
    if (inside[slot / 2]) continue;
    difference += std::pow(displacement[slot] - expected[slot], 2);
    size += std::pow(expected[slot], 2);
  }
  result.error = std::sqrt(difference / size);
  return result;
}

}  // namespace perilink::verification
