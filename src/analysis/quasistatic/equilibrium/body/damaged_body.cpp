#include "analysis/quasistatic/equilibrium/body/damaged_body.hpp"

#include <algorithm>
#include <cmath>

#include "assembly/internal_force.hpp"
#include "assembly/stiffness.hpp"

namespace perilink {

DamagedBody::DamagedBody(const LoadedNetwork& problem, const Unknowns& unknowns,
                         const ElementState* saved)
    : network_(problem.network),
      secants_(static_cast<std::size_t>(network_.num_elements()), 1.0),
      has_kept_(network_.has_kept_shear()),
      faces_(network_) {
  if (network_.has_closing() || has_kept_) axial_ = secants_;
  const std::vector<Index> contacts = network_.contacts();
  for (const Index element : contacts) secants_[element] = 0.0;  // closed at first
  if (saved != nullptr) {
    secants_ = saved->secants;
    axial_ = saved->axial;
    ground_stiffness_ = saved->ground_stiffness;
  }
  const auto& damaged = saved != nullptr ? saved->damaged : contacts;
  for (const Index element : damaged) {
    if (saved != nullptr) faces_.set_closed_ratio(element, saved->closed[unilateral_.size()]);
    unilateral_.push_back(ends_of(element));
    if (secants_[element] == 0.0 && faces_.concerns(element)) faces_.set_broken(element, true);
  }
  faces_.take_around_broken();
  set_unknowns(unknowns);
}

ElementState DamagedBody::state() const {
  ElementState state{secants_, axial_, {}, {}, ground_stiffness_, {}, {}};
  for (const UnilateralElement& bond : unilateral_) {
    state.damaged.push_back(bond.element);
    state.closed.push_back(faces_.closed_ratio(bond.element));
  }
  return state;
}

void DamagedBody::set_unknowns(const Unknowns& unknowns) {
  unknowns_ = &unknowns;
  slot_of_ = unknowns.slots();
  moving_slots_.clear();
  for (std::size_t slot = 0; unknowns.carries() && slot < unknowns.number.size(); ++slot) {
    if (unknowns.number[slot] != no_index) moving_slots_.push_back(slot);
  }
}

void DamagedBody::move(std::span<const double> q, std::vector<double>& displacement) const {
  if (unknowns_->carries()) return unknowns_->expand(q, moving_slots_, displacement);
  for (std::size_t k = 0; k < slot_of_.size(); ++k) displacement[slot_of_[k]] = q[k];
}

void DamagedBody::multiply(std::span<const double> q, std::span<double> result) const {
  std::vector<double> motion(unknowns_->number.size(), 0.0);
  move(q, motion);
  const std::vector<double> forces =
      unknowns_->restrict(internal_force(network_, secants(), motion).forces);
  for (std::size_t k = 0; k < forces.size(); ++k) {
    result[k] = forces[k] + (ground_stiffness_.empty() ? 0.0 : ground_stiffness_[k] * q[k]);
  }
}

SparseMatrix DamagedBody::stiffness() const {
  SparseMatrix stiffness = assemble_stiffness(network_, secants(), *unknowns_);
  for (std::size_t k = 0; k < ground_stiffness_.size(); ++k) {
    const Index unknown = static_cast<Index>(k);
    stiffness.coeffRef(unknown, unknown) += ground_stiffness_[k];
  }
  return stiffness;
}

void DamagedBody::weaken(Index element, double secant) {
  const bool is_first = secants_[element] == 1.0;
  if (has_sides() && is_first && network_.law(element).closes())
    unilateral_.push_back(ends_of(element));
  const bool breaks = secant == 0.0 && secants_[element] > 0.0;
  set_secant(element, secant);
  if (breaks && faces_.concerns(element)) faces_.set_broken(element, true);
}

void DamagedBody::take_back(Index element, double secant, bool intact) {
  const auto is_it = [&](const UnilateralElement& bond) { return bond.element == element; };
  if (intact) std::erase_if(unilateral_, is_it);
  if (secants_[element] == 0.0 && faces_.concerns(element)) faces_.set_broken(element, false);
  set_secant(element, secant);
}

Removal DamagedBody::removal(const Unknowns& unknowns, Index element, double secant) const {
  if (!keeps_shear(element)) {
    return make_removal(network_, unknowns, element, secants_[element] - secant);
  }
  const double axial = axial_[element] - secant;
  return secant > 0.0 || secants_[element] == 0.0
             ? make_axial_removal(network_, unknowns, element, axial)
             : make_removal(network_, unknowns, element, 1.0, axial);
}

Removal DamagedBody::one_sided_removal(Index element) const {
  return make_axial_removal(network_, *unknowns_, element, one_sided(element));
}

UnilateralElement DamagedBody::ends_of(Index element) const {
  const auto width = static_cast<std::size_t>(network_.width());
  UnilateralElement ends{
      element, width * network_.bonds.first[element], width * network_.bonds.second[element], {}};
  std::ranges::copy(network_.bonds.direction(element), ends.n);
  return ends;
}

void DamagedBody::add_ground_spring(Index unknown, double stiffness) {
  ground_stiffness_.resize(num_unknowns(), 0.0);
  ground_stiffness_[unknown] += stiffness;
}

bool DamagedBody::is_grounded(Index element) const {
  if (ground_stiffness_.empty()) return false;
  const auto width = static_cast<std::size_t>(network_.width());
  bool held = false;
  for (const Index end : {network_.bonds.first[element], network_.bonds.second[element]}) {
    for (std::size_t slot = end * width; slot < (end + 1) * width; ++slot) {
      unknowns_->for_each(slot,
                          [&](Index k, double) { held = held || ground_stiffness_[k] > 0.0; });
    }
  }
  return held;
}

}  // namespace perilink
