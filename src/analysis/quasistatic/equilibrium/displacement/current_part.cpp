#include "analysis/quasistatic/equilibrium/displacement/current_part.hpp"

#include <algorithm>
#include <cmath>

namespace perilink {

std::vector<std::uint8_t> CurrentPart::select_ends(const DamagedBody& body) {
  const Network& network = body.network();
  const Unknowns& unknowns = body.unknowns();
  const Bonds& bonds = network.bonds;
  std::vector<std::uint8_t> current(static_cast<std::size_t>(network.particles.size()), 0);
  for (Index e = 0; e < network.num_elements(); ++e) {
    if (network.has_limit(e)) current[bonds.first[e]] = current[bonds.second[e]] = 1;
  }
  for (const UnilateralElement& bond : body.unilateral()) {
    current[bonds.first[bond.element]] = current[bonds.second[bond.element]] = 1;
  }
  std::vector<std::uint8_t> wanted(body.num_unknowns(), 0);
  const auto width = static_cast<std::size_t>(network.width());
  slots_.clear();
  for (std::size_t slot = 0; slot < unknowns.number.size(); ++slot) {
    if (current[slot / width] == 0) continue;
    if (unknowns.carries() && unknowns.number[slot] != no_index) slots_.push_back(slot);
    unknowns.for_each(slot, [&](Index unknown, double) { wanted[unknown] = 1; });
  }
  is_all_ = std::ranges::none_of(wanted, [](std::uint8_t flag) { return flag == 0; });
  if (!is_all_) select_checked(body, current);
  return wanted;
}

/// Selects the elements and unknowns of the residual check.
/// \param current  per particle: its displacements are kept current
void CurrentPart::select_checked(const DamagedBody& body,
                                 const std::vector<std::uint8_t>& current) {
  const Network& network = body.network();
  const Bonds& bonds = network.bonds;
  const std::vector<std::size_t>& slots = body.slots();
  checked_elements_.clear();
  checked_.assign(slots.size(), 0);
  // Rows reach further than a bond.
  if (body.unknowns().carries() || network.has_states()) return;
  std::vector<std::uint8_t> inside = current;
  for (Index e = 0; e < network.num_elements(); ++e) {
    if (current[bonds.first[e]] == 0) inside[bonds.second[e]] = 0;
    if (current[bonds.second[e]] == 0) inside[bonds.first[e]] = 0;
  }
  for (Index k = 0; network.cells && k < network.cells->cells.size(); ++k) {
    for (const Index i : network.cells->cells.cell(k)) inside[i] = 0;
  }
  for (Index e = 0; e < network.num_elements(); ++e) {
    if (inside[bonds.first[e]] + inside[bonds.second[e]] > 0) checked_elements_.push_back(e);
  }
  for (std::size_t k = 0; k < slots.size(); ++k) {
    checked_[k] = inside[slots[k] / static_cast<std::size_t>(network.width())];
  }
  if (std::ranges::count(checked_, 1) == 0) checked_elements_.clear();
}

void CurrentPart::move(const DamagedBody& body, std::span<const double> values,
                       std::vector<double>& displacement) const {
  if (!is_all_ && body.unknowns().carries()) {
    body.unknowns().expand(values, slots_, displacement);
  } else {
    body.move(values, displacement);
  }
}

double CurrentPart::residual(const DamagedBody& body, const Loads& loads,
                             std::span<const double> displacement, InternalForce& internal) const {
  const Network& network = body.network();
  internal_force(network, body.secants(), displacement, checked_elements_, internal);
  double square = 0.0;
  for (std::size_t k = 0; k < checked_.size(); ++k) {
    if (checked_[k] == 0) continue;
    const std::size_t slot = body.slots()[k];
    double missing = loads.forces[slot] - internal.forces[slot];
    if (!network.support_stiffness.empty()) {
      missing -= network.support_stiffness[slot] * displacement[slot];
    }
    square += missing * missing;
  }
  return std::sqrt(square);
}

}  // namespace perilink
