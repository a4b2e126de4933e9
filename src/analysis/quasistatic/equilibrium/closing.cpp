// Crack closure: damaged bonds whose law allows it have their intact stiffness in compression. The
// energy is convex and has one minimum. Changing the contact states of violated bonds finds it.

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <utility>

#include "analysis/quasistatic/equilibrium/equilibrium.hpp"
#include "base/error.hpp"
#include "base/rare_branch.hpp"
#include "solver/not_positive_definite.hpp"

namespace perilink {
namespace {

/// Rounds in which all violated bonds change together before line searches, and most rounds.
constexpr int rounds_together = 10, most_rounds = 1000;

/// Fraction of the ends' motion below which an extension is round-off and has no sign [-].
constexpr double closing_round_off = 1e-11;

/// Compliance of a load along opened bonds, over that of a single bond, above which the body does
/// not resist it.
constexpr double no_resistance = 1e12;

/// Rough rates of one core, to choose between a new factor and changes that pass through it.
constexpr double flops_per_second = 15e9, bytes_per_second = 36e9, seconds_per_element = 1e-7;

template <class BondEnds>
BondEnds ends_of(const Network& network, Index element) {
  const auto width = static_cast<std::size_t>(network.width());
  BondEnds ends{width * network.bonds.first[element], width * network.bonds.second[element], {}};
  std::ranges::copy(network.bonds.direction(element), ends.n);
  return ends;
}

}  // namespace

/// Returns the ends of damaged_. They are contiguous in memory since every event reads all of them.
std::span<const Equilibrium::BondEnds> Equilibrium::damaged_ends() const {
  while (damaged_ends_.size() < damaged_.size()) {
    damaged_ends_.push_back(ends_of<BondEnds>(network_, damaged_[damaged_ends_.size()]));
  }
  return damaged_ends_;
}

/// Computes an extension. If it is zero up to round-off, the direction of the load is decisive.
template <int Dim>
auto Equilibrium::extension_at(const BondEnds& bond) const -> Extension {
  const double* const n = bond.n;
  Extension result;
  double size = 0.0;
  const auto add = [&](const std::vector<double>& u, double factor, double& sum) {
    const double* const from = u.data() + bond.first;
    const double* const to = u.data() + bond.second;
    for (int a = 0; a < Dim; ++a) {
      sum += n[a] * (to[a] - from[a]);
      size += std::abs(factor * n[a]) * (std::abs(to[a]) + std::abs(from[a]));
    }
  };
  const double load_factor = constant_ ? constant_->load_factor : 1.0;
  add(displacement_, load_factor, result.growing);
  if (constant_) add(constant_->displacement, 1.0, result.constant);
  result.now = load_factor * result.growing + result.constant;
  if (subdomains_ != nullptr) {  // errors of parts that move far spread everywhere
    size += std::abs(load_factor) * largest_motion_ + (constant_ ? constant_->largest_motion : 0.0);
  }
  const double noise = closing_round_off * size + noise_of_sides_;
  if (std::abs(result.now) <= noise) result.now = 0.0;
  result.side = result.now != 0.0 ? result.now : direction_ * result.growing;
  if (std::abs(result.side) <= noise_of_sides_) result.side = 0.0;
  return result;
}

auto Equilibrium::extension_of(Index element) const -> Extension {
  const BondEnds e = ends_of<BondEnds>(network_, element);
  return network_.dim() == 2 ? extension_at<2>(e) : extension_at<3>(e);
}

/// Calls visit(element, extension) for all of damaged_.
template <class Visit>
void Equilibrium::for_each_damaged(Visit visit) const {
  const std::span<const BondEnds> ends = damaged_ends();
  const bool in_space = network_.dim() == 3;
  for (std::size_t k = 0; k < ends.size(); ++k) {
    visit(damaged_[k], in_space ? extension_at<3>(ends[k]) : extension_at<2>(ends[k]));
  }
}

/// Returns whether a ground spring holds an end of the element.
bool Equilibrium::is_grounded(Index element) const {
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

/// Returns violated bonds: closed ones in tension and open ones in compression.
std::vector<Index> Equilibrium::on_wrong_side() const {
  std::vector<Index> wrong;
  for_each_damaged([&](Index element, const Extension& extension) {
    const bool closed = is_closed(element);
    const bool wants_change = closed ? extension.side > 0.0 : extension.side < 0.0;
    if (wants_change && (closed || !is_grounded(element))) wrong.push_back(element);
  });
  return wrong;
}

void Equilibrium::close(Index element) {
  const Removal axial = make_axial_removal(network_, *unknowns_, element, 1.0 - secants_[element]);
  factor_->update(axial.x[0]);  // before the stiffness changes
  axial_[element] = 1.0;
}

/// Opens a closed bond.
/// \return false if only this bond holds the body; then at most the factor is new
bool Equilibrium::open(Index element) {
  const Removal axial = make_axial_removal(network_, *unknowns_, element, 1.0 - secants_[element]);
  double pivot = factor_->pivot(axial.x[0]);
  const bool uncertain = !(pivot > uncertain_pivot);
  if (uncertain) {
    pivot = pivot_by_energy(axial.x[0], element, secants_[element]);
    axial_[element] = 1.0;  // pivot_by_energy() has set it to the secant of an open bond
    if (pivot == 0.0) return false;
  }
  axial_[element] = secants_[element];
  if (!uncertain) {
    factor_->downdate(axial.vectors(), axial.load_changes(), {&pivot, 1}, {});
    return true;
  }
  try {
    factorize();
    return true;
  } catch (const NotPositiveDefinite&) {
    axial_[element] = 1.0;
    factorize();
    return false;
  }
}

/// Returns whether a new factor costs less than this number of changes.
bool Equilibrium::is_cheaper_anew(std::size_t changes) const {
  // Each change needs a block of columns; a cleared cache lacks all of its blocks.
  if (subdomains_ != nullptr) return changes > subdomains_->num_blocks() + 1;
  const FactorStatistics factor = factor_->statistics();
  const double anew = factor.flops / flops_per_second +
                      seconds_per_element * static_cast<double>(network_.num_elements());
  return static_cast<double>(changes) * factor.bytes / bytes_per_second > anew ||
         take_rare_branch("new factor for sides");
}

void Equilibrium::turn(const std::vector<Index>& elements) {
  for (const Index element : elements) {
    axial_[element] = is_closed(element) ? secants_[element] : 1.0;
  }
}

/// Changes all contact states at once, with one new factor.
/// \return false if bonds that open held the body; then all is unchanged
bool Equilibrium::change_together(const std::vector<Index>& wrong) {
  turn(wrong);
  try {
    factorize();
    if (holds_apart(wrong)) return true;
  } catch (const NotPositiveDefinite&) {
  }
  turn(wrong);
  factorize();
  return false;
}

/// Returns whether the body resists where bonds have opened. If only round-off resists a motion,
/// the work of forces along these bonds is too large. Forces of different sizes move bonds apart in
/// every motion in which some of them open.
bool Equilibrium::holds_apart(const std::vector<Index>& opened) const {
  std::vector<double> load(solution_.size(), 0.0), motion(solution_.size(), 0.0);
  double size = 0.5;
  for (const Index element : opened) {
    if (is_closed(element)) continue;
    const double fraction = 1.0 - secants_[element];
    const Removal axial = make_axial_removal(network_, *unknowns_, element, fraction);
    const SparseVector& x = axial.x[0];
    for (int k = 0; k < x.size(); ++k) load[x.rows[k]] += size * x.values[k];
    size = size < 1.0 ? size + 0.381966 : size - 0.618034;  // sizes do not repeat
  }
  factor_->solve(load, motion);
  double work = 0.0;
  for (std::size_t k = 0; k < load.size(); ++k) work += load[k] * motion[k];
  return work >= 0.0 && work < no_resistance;
}

/// Changes contact states. Bonds that close hold the body while others open.
/// \return bonds that changed; none if the violated bonds hold the body
std::vector<Index> Equilibrium::change_sides(std::vector<Index> wrong) {
  // Broken bonds that open may free a part that the load does not move.
  const auto may_free = [&](Index e) { return is_closed(e) && secants_[e] == 0.0; };
  found_sides_ = (lags_ || follows_subdomains()) && std::ranges::none_of(wrong, may_free);
  if (found_sides_) {
    turn(wrong);
    if ((found_sides_ = search_equilibrium())) return wrong;
    turn(wrong);
  }
  bring_factor_up();
  if (is_cheaper_anew(wrong.size()) && change_together(wrong)) return wrong;
  const auto opening = std::stable_partition(wrong.begin(), wrong.end(),
                                             [&](Index element) { return !is_closed(element); });
  for (auto element = wrong.begin(); element != opening; ++element) close(*element);
  wrong.erase(std::remove_if(opening, wrong.end(), [&](Index element) { return !open(element); }),
              wrong.end());
  return wrong;
}

/// Adds the growth of f'u - R'd from one equilibrium to the other, u_1' (K_1 - K_2) u_2.
void Equilibrium::add_growth(Index element, const Extension& before, EventOutcome& outcome) const {
  const Extension after = extension_of(element);
  const double lost =
      network_.stiffness[element] * (1.0 - secants_[element]) * (is_closed(element) ? -1.0 : 1.0);
  outcome.compliance_growth += lost * before.growing * after.growing;
  outcome.permanent_growth.linear += 2.0 * lost * before.constant * after.growing;
  outcome.permanent_growth.constant += lost * before.constant * after.constant;
}

/// Changes contact states and finds equilibrium. Returns false if the violated bonds hold the body.
bool Equilibrium::follow_sides(const std::vector<Index>& wrong, EventOutcome& outcome) {
  std::vector<std::pair<Extension, bool>> before;  // with whether it was closed
  for (const Index element : wrong) before.emplace_back(extension_of(element), is_closed(element));
  const int factors = factor_->factorizations();
  const std::vector<Index> changed = change_sides(wrong);
  if (changed.empty()) return false;
  changed_sides_.insert(changed_sides_.end(), changed.begin(), changed.end());
  if (!found_sides_ && (options_.event_tolerance == 0.0 || partial_ || subdomains_ != nullptr ||
                        factor_->factorizations() != factors)) {
    refresh();
  } else if (!found_sides_) {
    ForceOfElements forces(solution_.size());
    for (std::size_t k = 0; k < wrong.size(); ++k) {
      const auto& [extension, was_closed] = before[k];
      if (is_closed(wrong[k]) == was_closed) continue;
      const double fraction = 1.0 - secants_[wrong[k]];
      const Removal axial = make_axial_removal(network_, *unknowns_, wrong[k], fraction);
      const double root =
          std::sqrt(network_.stiffness[wrong[k]] * fraction) * (was_closed ? 1.0 : -1.0);
      forces.add(axial.x[0], root * extension.growing, root * extension.constant);
    }
    follow_forces(forces);
    force_work_ = work_of_forces();
  }
  events_to_follow_ = 0;
  for (std::size_t k = 0; k < wrong.size(); ++k) {
    const auto& [extension, was_closed] = before[k];
    if (is_closed(wrong[k]) != was_closed) add_growth(wrong[k], extension, outcome);
  }
  return true;
}

/// Returns the motion of all particles that decides the contact states. It is the present one, or
/// the one of growing loads if only bonds with zero extension may change.
std::vector<double> Equilibrium::telling_motion() const {
  std::vector<double> motion = displacement_;
  const double factor = direction_ != 0.0 ? direction_ : constant_ ? constant_->load_factor : 1.0;
  for (double& value : motion) value *= factor;
  if (direction_ != 0.0 || !constant_) return motion;
  for (std::size_t k = 0; k < motion.size(); ++k) motion[k] += constant_->displacement[k];
  return motion;
}

/// Returns the extensions of damaged_ in a motion; zero for bonds that cannot change now.
std::vector<double> Equilibrium::telling_extensions(std::span<const double> motion) const {
  const auto width = static_cast<std::size_t>(network_.width());
  std::vector<double> extensions;
  for (const Index element : damaged_) {
    const std::span<const double> n = network_.bonds.direction(element);
    const std::size_t i = width * network_.bonds.first[element];
    const std::size_t j = width * network_.bonds.second[element];
    double sum = 0.0;
    for (int a = 0; a < network_.dim(); ++a) sum += n[a] * (motion[j + a] - motion[i + a]);
    const bool fixed =
        is_grounded(element) || (direction_ != 0.0 && extension_of(element).now != 0.0);
    extensions.push_back(fixed ? 0.0 : sum);
  }
  return extensions;
}

/// Returns the fraction t of the way between two motions at which the energy is least. The second
/// is the equilibrium of the present contact states. The derivative at t is
///
///   -(1 - t) q + sum over bonds that changed contact state of +-k (1 - a) e(t) (e_to - e_from),
///
/// where q is twice the energy of the difference. The slope changes where an extension is zero.
double Equilibrium::line_minimum(std::span<const double> from, std::span<const double> to) const {
  std::vector<double> difference(to.begin(), to.end());
  for (std::size_t k = 0; k < difference.size(); ++k) difference[k] -= from[k];
  double slope = 2.0 * internal_force(network_, secants(), difference).energy;
  double value = -slope;  // derivative at t = 0
  const std::vector<double> begin = telling_extensions(from), end = telling_extensions(to);
  std::vector<std::pair<double, double>> bends;  // position, and growth of the slope there
  for (std::size_t k = 0; k < damaged_.size(); ++k) {
    const double growth = end[k] - begin[k];
    const bool changes = begin[k] * end[k] < 0.0;
    if (!changes) continue;
    const double stiffness = network_.stiffness[damaged_[k]] * (1.0 - secants_[damaged_[k]]);
    const double sign = is_closed(damaged_[k]) ? -1.0 : 1.0;
    bends.emplace_back(-begin[k] / growth, sign * stiffness * growth * growth);
  }
  std::sort(bends.begin(), bends.end());
  double place = 0.0;
  for (const auto& [next, bend] : bends) {
    if (value + slope * (next - place) >= 0.0) break;
    value += slope * (next - place);
    slope += bend;
    place = next;
  }
  return slope > 0.0 ? std::min(1.0, place - value / slope) : 1.0;
}

/// Finds the contact states. All violated bonds change together, usually for one or two rounds.
/// After that, line searches follow the energy down, each on the way to the equilibrium of the
/// present states. Extensions within the round-off of the whole motion then have no contact state.
/// Otherwise, bodies that an event has cut through and unloaded would never settle.
/// \throws SolverError after most_rounds
void Equilibrium::settle_closing(EventOutcome& outcome) {
  changed_sides_.clear();
  std::vector<double> reached;  // end of the line search so far
  for (int round = 0; round < most_rounds; ++round) {
    std::vector<double> aim;
    if (round >= rounds_together) aim = telling_motion();
    noise_of_sides_ = closing_round_off * largest_of(aim);
    std::vector<Index> wrong = on_wrong_side();
    noise_of_sides_ = 0.0;
    if (wrong.empty()) return;
    if (!aim.empty()) {
      if (reached.empty()) reached = aim;
      const double part = round == rounds_together ? 1.0 : line_minimum(reached, aim);
      for (std::size_t k = 0; k < aim.size(); ++k) reached[k] += part * (aim[k] - reached[k]);
      const std::vector<double> extensions = telling_extensions(reached);
      wrong.clear();
      for (std::size_t k = 0; k < damaged_.size(); ++k) {
        const bool closed = is_closed(damaged_[k]);
        if (closed ? extensions[k] > 0.0 : extensions[k] < 0.0) wrong.push_back(damaged_[k]);
      }
      if (wrong.empty()) return;
    }
    outcome.mechanism = !follow_sides(wrong, outcome);
    if (outcome.mechanism) return;
  }
  throw SolverError(
      fmt::format("the contact states of damaged bonds do not settle in {} rounds", most_rounds));
}

/// Reverts an event that separates the body.
void Equilibrium::take_back(Index element, double secant) {
  if (secant == 1.0) std::erase(damaged_, element);
  damaged_ends_.clear();
  for (const Index other : changed_sides_) {
    axial_[other] = is_closed(other) ? secants_[other] : 1.0;
  }
  set_secant(element, secant);
  events_to_follow_ = 0;
  factorize();
}

auto Equilibrium::next_side_change(double distance) const -> SideChange {
  SideChange next{no_index, distance};
  for_each_damaged([&](Index element, const Extension& extension) {
    const double growth = std::copysign(1.0, distance) * extension.growing;
    if (!(is_closed(element) ? growth > 0.0 : growth < 0.0)) return;
    if (!is_closed(element) && is_grounded(element)) return;
    const double change = -extension.now / extension.growing;
    if (std::abs(change) < std::abs(next.distance)) next = {element, change};
  });
  return next;
}

EventOutcome Equilibrium::pass_side_change(double direction) {
  EventOutcome outcome;
  outcome.secant = 1.0;
  outcome.changed_side = true;
  direction_ = direction;
  settle_closing(outcome);
  direction_ = 0.0;
  return outcome;
}

/// Opens initial cracks before the first event.
void Equilibrium::open_cut_elements() {
  if (damaged_.empty()) return;
  EventOutcome outcome;
  settle_closing(outcome);
  if (outcome.mechanism) throw CracksSeparate();
}

}  // namespace perilink
