#include "analysis/quasistatic/equilibrium/displacement/permanent_load.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "assembly/stiffness.hpp"
#include "network/unknowns.hpp"
#include "solver/conjugate_gradients.hpp"

namespace perilink {
namespace {

/// Returns the work of loads on slots that are not prescribed.
double work_on(const Unknowns& unknowns, const Loads& loads, std::span<const double> motion) {
  double work = 0.0;
  for (std::size_t slot = 0; slot < motion.size(); ++slot) {
    if (unknowns.number[slot] != no_index) work += loads.forces[slot] * motion[slot];
  }
  return work;
}

}  // namespace

PermanentLoad::PermanentLoad(const DamagedBody& body, Update& update, ConstantLoads given,
                             std::vector<double> ground_load)
    : body_(body), update_(update), given_(std::move(given)) {
  field_.ground_load = std::move(ground_load);
  find_driven_slots();
}

void PermanentLoad::find_driven_slots() {
  const Network& network = body_.network();
  const auto width = static_cast<std::size_t>(network.width());
  const std::vector<double>& growing = body_.unknowns().prescribed;
  std::vector<std::uint8_t> driven(static_cast<std::size_t>(network.particles.size()), 0);
  for (std::size_t slot = 0; slot < growing.size(); ++slot) {
    if (growing[slot] == 0.0 && given_.unknowns.prescribed[slot] == 0.0) continue;
    driven_slots_.push_back(slot);
    driven[slot / width] = 1;
  }
  if (driven_slots_.empty()) return;
  for (Index e = 0; e < network.num_elements(); ++e) {
    if (driven[network.bonds.first[e]] || driven[network.bonds.second[e]]) {
      driven_elements_.push_back(e);
    }
  }
}

void PermanentLoad::set_unknowns(const Unknowns& unknowns) {
  std::vector<double> stays = std::move(given_.unknowns.prescribed);
  given_.unknowns = unknowns;
  given_.unknowns.prescribed = std::move(stays);
}

void PermanentLoad::set_values(std::vector<double> values) {
  field_.values = std::move(values);
  apply();
}

void PermanentLoad::refresh() {
  const std::vector<double> wanted = field_.measure_load(body_, given_.unknowns, given_.loads);
  field_.values.assign(wanted.size(), 0.0);
  const auto moves = [](double u) { return u != 0.0; };
  rests_ = field_.load_norm == 0.0 && std::ranges::none_of(given_.unknowns.prescribed, moves);
  if (field_.load_norm > 0.0) update_.inverse().solve(wanted, field_.values);
  apply();
}

bool PermanentLoad::search() {
  std::vector<double> residual = load(), forces(residual.size());
  body_.multiply(field_.values, forces);
  const double energy = scalar_product(field_.values, forces);
  for (std::size_t k = 0; k < residual.size(); ++k) residual[k] -= forces[k];
  const bool found = update_.search(residual, field_.values, energy, LoadSet::permanent);
  apply();
  return found;
}

void PermanentLoad::follow(const Removal& removal) {
  if (rests_) return;
  Removal::Deformations shares{};
  for (int m = 0; m < removal.rank; ++m) shares[m] = removal.constant[m] / removal.pivot[m];
  const SparseVector sum = combine(removal.vectors(), shares);
  add(1.0, update_.inverse().columns({&sum, 1}));
}

void PermanentLoad::add_solution(const SparseVector& forces) {
  if (!rests_) update_.inverse().add_solution(forces, field_.values);
}

void PermanentLoad::apply() {
  field_.displacement = given_.unknowns.expand(field_.values);
  if (update_.drift())
    field_.largest_motion = largest_displacement(body_.network(), field_.displacement);
}

ConstantWork PermanentLoad::work(const Loads& loads, std::span<const double> displacement) const {
  ConstantWork work;
  if (rests_) return work;
  const Network& network = body_.network();
  const Unknowns& growing = body_.unknowns();
  work.forces = work_on(growing, given_.loads, field_.displacement);
  work.forces_on_motion = work_on(growing, given_.loads, displacement);
  work.growing_forces = work_on(growing, loads, field_.displacement);
  if (driven_slots_.empty()) return work;
  InternalForce internal;
  internal_force(network, body_.secants(), field_.displacement, driven_elements_, internal);
  for (const std::size_t slot : driven_slots_) {
    double force = internal.forces[slot];
    if (!network.support_stiffness.empty()) {
      force += network.support_stiffness[slot] * field_.displacement[slot];
    }
    work.supports += force * given_.unknowns.prescribed[slot];
    work.growing_supports += force * growing.prescribed[slot];
    work.forces_on_clamps += given_.loads.forces[slot] * growing.prescribed[slot];
  }
  return work;
}

}  // namespace perilink
