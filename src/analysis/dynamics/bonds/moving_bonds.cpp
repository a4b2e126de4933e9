#include "analysis/dynamics/bonds/moving_bonds.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace perilink {

int main_component(const LoadedNetwork& problem) {
  const Unknowns& unknowns = problem.unknowns;
  std::vector<double> driven(unknowns.width, 0.0), loaded(unknowns.width, 0.0);
  for (std::size_t slot = 0; slot < unknowns.number.size(); ++slot) {
    double& largest = driven[slot % unknowns.width];
    largest = std::max(largest, std::abs(unknowns.prescribed[slot]));
    loaded[slot % unknowns.width] += problem.loads.forces[slot];
  }
  const auto motion = std::max_element(driven.begin(), driven.end());
  if (*motion > 0.0) return static_cast<int>(motion - driven.begin());
  const auto force = std::max_element(loaded.begin(), loaded.end(),
                                      [](double a, double b) { return std::abs(a) < std::abs(b); });
  return static_cast<int>(force - loaded.begin());
}

MovingBonds::MovingBonds(const LoadedNetwork& problem, const Inertia& masses,
                         std::unique_ptr<ExplicitBonds> elements, double step_length)
    : network(problem.network),
      unknowns(problem.unknowns),
      loads(problem.loads.forces),
      reference(problem.reference),
      mass(masses.mass),
      bonds(std::move(elements)),
      time_step(step_length),
      component(main_component(problem)),
      blocks(network.particles.size(), unknowns.width),
      broken(blocks.count()),
      force(unknowns.number.size(), 0.0),
      sums(static_cast<std::size_t>(blocks.count())) {
  motion.displacement = motion.velocity = force;
}

void MovingBonds::lose(Index block, Index step, const BondLosses& losses) {
  sums[block].fractured += losses.fractured;
  broken.add(block, step, losses.broken);
}

void MovingBonds::prepare(Index block, Index step) {
  lose(block, step, bonds->prepare(blocks.begin(block), blocks.end(block), time_step, motion));
}

void MovingBonds::find_forces(Index block, Index step) {
  lose(block, step,
       bonds->forces(blocks.begin(block), blocks.end(block), time_step, motion, force));
  if (network.support_stiffness.empty()) return;
  blocks.for_slots(block, [&](std::size_t slot) {
    force[slot] += network.support_stiffness[slot] * motion.displacement[slot];
  });
}

double MovingBonds::stored(Index begin, Index end) const {
  double energy = bonds->stored(begin, end, time_step, motion);
  if (network.support_stiffness.empty()) return energy;
  const auto width = static_cast<std::size_t>(unknowns.width);
  for (std::size_t slot = begin * width; slot < end * width; ++slot) {
    const double u = motion.displacement[slot];
    energy += 0.5 * network.support_stiffness[slot] * u * (u - time_step * motion.velocity[slot]);
  }
  return energy;
}

std::vector<double> MovingBonds::reactions(double load_factor, double increment,
                                           double damping) const {
  const std::vector<double>& springs = network.support_stiffness;
  std::vector<double> all(force.size(), 0.0);
  for (std::size_t slot = 0; slot < all.size(); ++slot) {
    if (is_held(slot)) {
      const double faster = unknowns.prescribed[slot] * increment / time_step;
      all[slot] = holding_force(slot, load_factor, faster, damping);
    }
    if (!springs.empty()) all[slot] -= springs[slot] * motion.displacement[slot];
  }
  return all;
}

void MovingBonds::add_reaction(std::size_t slot, double reaction, MotionSums& to) const {
  to.driven += reaction * unknowns.prescribed[slot];
  const bool is_support = unknowns.prescribed[slot] == 0.0;
  if (is_support && static_cast<int>(slot % unknowns.width) == component) to.supports += reaction;
}

MotionSums MovingBonds::total() const {
  MotionSums all;
  for (const MotionSums& block : sums) {
    all.fractured += block.fractured;
    all.work.external += block.work.external;
    all.work.damping += block.work.damping;
    all.stored += block.stored;
    all.kinetic += block.kinetic;
    all.driven += block.driven;
    all.supports += block.supports;
    all.loaded += block.loaded;
  }
  return all;
}

void MovingBonds::save(BondsState& state) {
  state.displacement = motion.displacement;
  state.velocity = motion.velocity;
  for (const MotionSums& block : sums) {
    state.fractured.push_back(block.fractured);
    state.external_work.push_back(block.work.external);
    state.damping_work.push_back(block.work.damping);
  }
  state.broken = broken.so_far();
  bonds->save(state.elements);
}

void MovingBonds::restore(const BondsState& state) {
  expect_equal_sizes(state.displacement.size(), motion.displacement.size());
  expect_equal_sizes(state.velocity.size(), motion.velocity.size());
  for (const auto* energies : {&state.fractured, &state.external_work, &state.damping_work}) {
    expect_equal_sizes(energies->size(), sums.size());
  }
  motion.displacement = state.displacement;
  motion.velocity = state.velocity;
  for (std::size_t b = 0; b < sums.size(); ++b) {
    sums[b].fractured = state.fractured[b];
    sums[b].work = {state.external_work[b], state.damping_work[b]};
  }
  broken.restore(state.broken);
  bonds->restore(state.elements);
}

void MovingBonds::note_reactions(const MotionSums& all, double load_factor,
                                 ExplicitRecord& record) const {
  record.load = reference.driven ? all.driven / reference.value : load_factor * reference.value;
  record.support_reaction = all.supports;
}

void MovingBonds::note_motion(const MotionSums& all, double motion_factor, ExplicitRecord& record) {
  record.displacement =
      reference.driven ? motion_factor * reference.value : all.loaded / reference.value;
  (bonds->has_states() ? record.cracked_particles : record.broken_bonds) =
      static_cast<Index>(broken.so_far().size());
}

}  // namespace perilink
