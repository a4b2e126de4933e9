// Constant and growing loads: a second field of displacements follows the same changes of the
// stiffness (docs/theory/events_and_energy.md, section 7).

#include <algorithm>
#include <cmath>
#include <utility>

#include "analysis/quasistatic/equilibrium/equilibrium.hpp"
#include "assembly/stiffness.hpp"
#include "base/error.hpp"

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

void Equilibrium::begin_stage(const Unknowns& unknowns, const Loads& loads,
                              ConstantField constant) {
  bring_factor_up();
  keep_all_current();
  const bool fewer_move = static_cast<std::size_t>(unknowns.count) != solution_.size();
  if (fewer_move && !ground_stiffness_.empty()) {
    throw SolverError("particles cannot be clamped while ground springs hold a loose part");
  }
  // Ground springs hold loose parts at their present positions.
  constant.ground_load = ground_load_;
  for (std::size_t k = 0; constant_ && k < ground_load_.size(); ++k) {
    constant.ground_load[k] = constant_->ground_load[k] + constant_->load_factor * ground_load_[k];
  }
  std::fill(ground_load_.begin(), ground_load_.end(), 0.0);
  unknowns_ = &unknowns;
  loads_ = &loads;
  constant_ = std::move(constant);
  find_driven_elements();
  find_driven_slots();
  displacement_ = unknowns.prescribed;
  find_loaded_slots();
  if (fewer_move) {
    factorize_anew();
  } else if (restored_) {
    factorize();
  }
  restored_ = false;
  events_to_follow_ = 0;
  last_work_ = 0.0;
  adopt_load();
}

void Equilibrium::go_on(const ElementState& saved) {
  if (saved.ground_load.empty()) return;
  ground_load_ = saved.ground_load;
  refresh();
}

void Equilibrium::restore(std::span<const Index> elements) {
  for (const Index element : elements) set_secant(element, 1.0);
  restored_ = restored_ || !elements.empty();
}

void Equilibrium::find_driven_slots() {
  const auto width = static_cast<std::size_t>(network_.width());
  std::vector<std::uint8_t> driven(static_cast<std::size_t>(network_.particles.size()), 0);
  for (std::size_t slot = 0; slot < unknowns_->prescribed.size(); ++slot) {
    if (unknowns_->prescribed[slot] == 0.0 && constant_->unknowns.prescribed[slot] == 0.0) continue;
    constant_->driven_slots.push_back(slot);
    driven[slot / width] = 1;
  }
  if (constant_->driven_slots.empty()) return;
  for (Index e = 0; e < network_.num_elements(); ++e) {
    if (driven[network_.bonds.first[e]] || driven[network_.bonds.second[e]]) {
      constant_->driven_elements.push_back(e);
    }
  }
}

void Equilibrium::refresh_constant() {
  ConstantField& field = *constant_;
  std::vector<double> load =
      assemble_right_hand_side(network_, secants(), field.unknowns, field.loads);
  for (std::size_t k = 0; k < field.ground_load.size(); ++k) load[k] += field.ground_load[k];
  field.load_norm = norm(load);
  field.solution.assign(load.size(), 0.0);
  const auto moves = [](double u) { return u != 0.0; };
  field.rests = field.load_norm == 0.0 && std::none_of(field.unknowns.prescribed.begin(),
                                                       field.unknowns.prescribed.end(), moves);
  if (field.load_norm > 0.0) factor_->solve(load, field.solution);
  scatter_constant();
}

void Equilibrium::scatter_constant() {
  ConstantField& field = *constant_;
  field.displacement = field.unknowns.expand(field.solution);
  if (subdomains_ != nullptr) field.largest_motion = largest_of(field.displacement);
}

void Equilibrium::refine_permanent() {
  ConstantField& field = *constant_;
  if (field.load_norm == 0.0) return;
  std::vector<double> load = field.unknowns.restrict(field.loads.forces);
  for (std::size_t k = 0; k < field.ground_load.size(); ++k) load[k] += field.ground_load[k];
  FineMotion motion{{field.solution.begin(), field.solution.end()},
                    {field.displacement.begin(), field.displacement.end()}};
  refine_finely(load, motion);
  for (std::size_t k = 0; k < load.size(); ++k) {
    field.solution[k] = static_cast<double>(motion.unknowns[k]);
  }
  scatter_constant();
}

ConstantWork Equilibrium::constant_work() {
  const ConstantField& field = *constant_;
  ConstantWork work;
  if (field.rests) return work;
  work.forces = work_on(*unknowns_, field.loads, field.displacement);
  work.forces_on_motion = work_on(*unknowns_, field.loads, displacement_);
  work.growing_forces = work_on(*unknowns_, *loads_, field.displacement);
  if (field.driven_slots.empty()) return work;
  internal_force(network_, secants(), field.displacement, field.driven_elements, internal_);
  for (const std::size_t slot : field.driven_slots) {
    double force = internal_.forces[slot];
    if (!network_.support_stiffness.empty()) {
      force += network_.support_stiffness[slot] * field.displacement[slot];
    }
    work.supports += force * field.unknowns.prescribed[slot];
    work.growing_supports += force * unknowns_->prescribed[slot];
    work.forces_on_clamps += field.loads.forces[slot] * unknowns_->prescribed[slot];
  }
  return work;
}

void Equilibrium::check_constant(Balance& balance) {
  const ConstantField& field = *constant_;
  if (field.rests) return;
  const auto measure = [&] {
    internal_force(network_, secants(), field.displacement, internal_);
    std::vector<double> missing(internal_.forces.size());
    for (std::size_t slot = 0; slot < missing.size(); ++slot) {
      missing[slot] = field.loads.forces[slot] - internal_.forces[slot];
    }
    std::vector<double> residual = field.unknowns.restrict(missing);
    for (std::size_t k = 0; k < field.ground_load.size(); ++k) {
      residual[k] += field.ground_load[k] - ground_stiffness_[k] * field.solution[k];
    }
    return field.load_norm > 0.0 ? norm(residual) / field.load_norm : 0.0;
  };
  double residual = measure();
  if (!(residual <= (subdomains_ == nullptr ? options_.residual_tolerance : fine_residual))) {
    refine_permanent();
    residual = measure();
  }
  balance.residual = std::max(balance.residual, residual);
  balance.stored_by_permanent.constant = internal_.energy;
  for (std::size_t slot = 0; slot < displacement_.size(); ++slot) {
    balance.stored_by_permanent.linear += internal_.forces[slot] * displacement_[slot];
  }
}

/// Returns the removal that takes an element to this secant.
Removal Equilibrium::removal_from(const Unknowns& unknowns, Index element, double secant) const {
  if (!keeps_shear(element)) {
    return make_removal(network_, unknowns, element, secants_[element] - secant);
  }
  const double axial = axial_[element] - secant;
  return secant > 0.0 || secants_[element] == 0.0
             ? make_axial_removal(network_, unknowns, element, axial)
             : make_removal(network_, unknowns, element, 1.0, axial);
}

/// Returns the removal with its deformation by constant loads.
Removal Equilibrium::removal_of(Index element, double secant) const {
  Removal removal = removal_from(*unknowns_, element, secant);
  if (!constant_) return removal;
  const Removal own = removal_from(constant_->unknowns, element, secant);
  for (int m = 0; m < own.rank; ++m) removal.constant[m] = own.deformation(m, constant_->solution);
  return removal;
}

/// Returns the deformations at the present load factor; without constant loads at load factor 1.
auto Equilibrium::deformations_now(const Removal& removal, Index element) const -> Deformations {
  Deformations result = deformations(removal, element);
  if (!constant_) return result;
  for (int m = 0; m < removal.rank; ++m) {
    result[m] = removal.constant[m] + constant_->load_factor * result[m];
  }
  return result;
}

/// Adds the released energy of permanent loads.
/// \return twice the energy that leaves the element at the present load factor
double Equilibrium::release_constant(const Removal& removal, Index element,
                                     EventOutcome& outcome) const {
  const Deformations growing = deformations(removal, element);
  for (int m = 0; m < removal.rank; ++m) {
    outcome.released_by_permanent.linear += growing[m] * removal.constant[m];
    outcome.released_by_permanent.constant += 0.5 * removal.constant[m] * removal.constant[m];
  }
  const double now = constant_->load_factor;
  return 2.0 * (now * now * outcome.released + outcome.released_by_permanent.at(now));
}

/// Updates both fields with one backward pass: a zero solution becomes K^-1 x / pivot.
void Equilibrium::commit_both(const Removal& removal) {
  const double growing = removal.deformation(0, solution_), one = 1.0;
  std::vector<double> motion(solution_.size(), 0.0);
  factor_->downdate(removal.vectors(), {&one, 1}, removal.pivots(), motion);
  for (std::size_t k = 0; k < motion.size(); ++k) {
    solution_[k] += growing * motion[k];
    constant_->solution[k] += removal.constant[0] * motion[k];
  }
}

/// Updates the displacements by constant loads before the factor makes the removal.
void Equilibrium::move_constant(const Removal& removal) {
  if (constant_->rests) return;
  Deformations shares{};
  for (int m = 0; m < removal.rank; ++m) shares[m] = removal.constant[m] / removal.pivot[m];
  const SparseVector sum = combine(removal.vectors(), shares);
  const std::vector<double> motion = factor_->columns({&sum, 1});
  for (std::size_t k = 0; k < motion.size(); ++k) constant_->solution[k] += motion[k];
}

}  // namespace perilink
