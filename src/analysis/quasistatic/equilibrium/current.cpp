#include <algorithm>
#include <cmath>
#include <numeric>

#include "analysis/quasistatic/equilibrium/equilibrium.hpp"
#include "base/rare_branch.hpp"

/// \file
/// Displacements and cached columns that events keep current.

namespace perilink {
namespace {

/// Largest error of a solution by columns, relative in the energy norm. It must be small, since an
/// element holds a small part of the energy.
constexpr double most_drift = 1e-10;

}  // namespace

/// Selects the displacements that events keep current. Under forces only, an event needs the ends
/// of elements that can fail. The backward pass then skips other parts of the body, and f'u is
/// updated by its growth. Prescribed displacements and stages need the reactions, and thus all
/// displacements.
void Equilibrium::choose_current_unknowns() {
  partial_ = false;
  moving_slots_.clear();
  current_slots_.clear();
  for (std::size_t slot = 0; unknowns_->carries() && slot < displacement_.size(); ++slot) {
    if (unknowns_->number[slot] != no_index) moving_slots_.push_back(slot);
  }
  if (!driven_elements_.empty() || constant_ || subdomains_ != nullptr) return;
  const Bonds& bonds = network_.bonds;
  std::vector<std::uint8_t> current(static_cast<std::size_t>(network_.particles.size()), 0);
  for (Index e = 0; e < network_.num_elements(); ++e) {
    if (network_.has_limit(e)) current[bonds.first[e]] = current[bonds.second[e]] = 1;
  }
  for (const Index e : damaged_) current[bonds.first[e]] = current[bonds.second[e]] = 1;
  std::vector<std::uint8_t> wanted(solution_.size(), 0);
  const auto width = static_cast<std::size_t>(network_.width());
  for (std::size_t slot = 0; slot < displacement_.size(); ++slot) {
    if (current[slot / width] == 0) continue;
    if (unknowns_->carries() && unknowns_->number[slot] != no_index) current_slots_.push_back(slot);
    unknowns_->for_each(slot, [&](Index unknown, double) { wanted[unknown] = 1; });
  }
  partial_ = std::any_of(wanted.begin(), wanted.end(), [](std::uint8_t flag) { return flag == 0; });
  if (!partial_) return;
  factor_->keep_current(wanted);
  choose_checked(current);
}

/// Selects the elements and unknowns of the cheap residual check.
/// \param current  per particle: its displacements are kept current
void Equilibrium::choose_checked(const std::vector<std::uint8_t>& current) {
  const Bonds& bonds = network_.bonds;
  checked_elements_.clear();
  checked_.assign(solution_.size(), 0);
  if (unknowns_->carries() || network_.has_states()) return;  // rows reach further than a bond
  std::vector<std::uint8_t> inside = current;
  for (Index e = 0; e < network_.num_elements(); ++e) {
    if (current[bonds.first[e]] == 0) inside[bonds.second[e]] = 0;
    if (current[bonds.second[e]] == 0) inside[bonds.first[e]] = 0;
  }
  for (Index k = 0; network_.cells && k < network_.cells->cells.size(); ++k) {
    for (const Index i : network_.cells->cells.cell(k)) inside[i] = 0;
  }
  for (Index e = 0; e < network_.num_elements(); ++e) {
    if (inside[bonds.first[e]] + inside[bonds.second[e]] > 0) checked_elements_.push_back(e);
  }
  for (std::size_t k = 0; k < slot_of_.size(); ++k) {
    checked_[k] = inside[slot_of_[k] / static_cast<std::size_t>(network_.width())];
  }
  const bool none = std::count(checked_.begin(), checked_.end(), 1) == 0;
  if (none) checked_elements_.clear();
}

/// Applies the unknowns to the displacements that events keep current.
void Equilibrium::scatter_current() {
  if (partial_ && unknowns_->carries()) {
    unknowns_->expand(solution_, current_slots_, displacement_);
  } else {
    scatter_solution();
  }
}

double Equilibrium::work_of_forces() const {
  double work = 0.0;
  for (const std::size_t slot : loaded_slots_) work += loads_->forces[slot] * displacement_[slot];
  return work;
}

/// Observers must not change the run, so missing displacements are solved for separately. Those of
/// an earlier state are wrong only away from elements that can fail, where the stiffness never
/// changes. The residual of that state therefore gives the correction with any later factor.
std::span<const double> Equilibrium::displacement(std::span<const double> earlier,
                                                  Secants secants) {
  if (earlier.empty() && !stale_) return where_elements_fail();
  std::vector<double> load;
  if (earlier.empty()) {
    load = present_load();
  } else {
    const bool may_lack = driven_elements_.empty() && !constant_ && subdomains_ == nullptr;
    if (!may_lack) return earlier;
    std::vector<double> forces = internal_force(network_, secants, earlier).forces;
    for (std::size_t slot = 0; slot < forces.size(); ++slot) {
      forces[slot] = loads_->forces[slot] - forces[slot];
    }
    load = unknowns_->restrict(forces);
    if (norm(load) <= options_.residual_tolerance * load_norm_) return earlier;
  }
  factor_->solve(load, load);
  observed_ = unknowns_->expand(load);
  for (std::size_t slot = 0; slot < earlier.size(); ++slot) {
    observed_[slot] += earlier[slot] - unknowns_->prescribed[slot];
  }
  return observed_;
}

double Equilibrium::residual_of_current() {
  internal_force(network_, secants(), displacement_, checked_elements_, internal_);
  double square = 0.0;
  for (std::size_t k = 0; k < solution_.size(); ++k) {
    if (checked_[k] == 0) continue;
    const std::size_t slot = slot_of_[k];
    double missing = loads_->forces[slot] - internal_.forces[slot];
    if (!network_.support_stiffness.empty()) {
      missing -= network_.support_stiffness[slot] * displacement_[slot];
    }
    square += missing * missing;
  }
  return std::sqrt(square) / load_norm_;
}

/// Keeps all displacements current from now on, since springs act on any of them.
void Equilibrium::keep_all_current() {
  if (partial_) factor_->keep_current(std::vector<std::uint8_t>(solution_.size(), 1));
  if (stale_) refresh();
  partial_ = false;
}

double Equilibrium::largest_of(std::span<const double> displacement) const {
  const auto width = static_cast<std::size_t>(network_.width());
  const auto dim = static_cast<std::size_t>(network_.dim());
  double largest = 0.0;
  for (std::size_t begin = 0; begin < displacement.size(); begin += width) {
    for (std::size_t slot = begin; slot < begin + dim; ++slot) {
      largest = std::max(largest, std::abs(displacement[slot]));
    }
  }
  return largest;
}

void Equilibrium::find_largest_motion() {
  if (subdomains_ == nullptr && !network_.carries_moments()) return;
  largest_motion_ = largest_of(displacement_);
}

/// Clears the column cache if a correction is large. The errors of columns grow with every event
/// that moves the same particles apart.
void Equilibrium::judge_columns(std::span<const double> missing,
                                std::span<const double> correction) {
  const double error = std::inner_product(missing.begin(), missing.end(), correction.begin(), 0.0);
  // Written so that an energy that is not a number is too large.
  const bool small = error <= most_drift * most_drift * 2.0 * internal_.energy;
  if (!small || take_rare_branch("cleared columns")) subdomains_->clear();
}

/// Removes errors of columns from the displacements.
/// \param size      norm of the residual over the norm of the load
/// \param residual  residual per unknown; overwritten
/// \return norm of the residual that is left, over the norm of the load
double Equilibrium::refine_followed(double size, std::vector<double>& residual) {
  if (size <= fine_residual) return size;
  const std::vector<double> missing = residual;
  refine(residual);  // now the correction
  judge_columns(missing, residual);
  if (!(size <= std::max(options_.residual_tolerance, most_drift))) look_closer_ = true;
  return measure_residual(residual);
}

bool Equilibrium::is_prepared(Index element) const {
  if (subdomains_ == nullptr) return true;
  const ElementVectors parts = element_vectors(network_, *unknowns_, element, 1.0);
  return std::all_of(parts.x.begin(), parts.x.begin() + parts.count,
                     [&](const SparseVector& x) { return subdomains_->holds(x); });
}

void Equilibrium::prepare(Index element, std::span<const Index> expected) {
  const auto vectors_of = [&](Index of, std::vector<SparseVector>& vectors) {
    const ElementVectors parts = element_vectors(network_, *unknowns_, of, 1.0);
    vectors.insert(vectors.end(), parts.x.begin(), parts.x.begin() + parts.count);
  };
  std::vector<SparseVector> own, next;
  vectors_of(element, own);
  for (const Index other : expected) vectors_of(other, next);
  subdomains_->expect(std::move(next));
  std::vector<double> residual;
  measure_residual(residual);
  const std::vector<double> missing = residual;
  if (!subdomains_->hold_and_correct(own, residual, 2.0 * internal_.energy)) return;
  for (std::size_t k = 0; k < residual.size(); ++k) solution_[k] += residual[k];
  scatter_solution();
  force_work_ = work_of_forces();
  judge_columns(missing, residual);
}

}  // namespace perilink
