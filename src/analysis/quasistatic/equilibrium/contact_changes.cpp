#include "analysis/quasistatic/equilibrium/contact_changes.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "base/error.hpp"
#include "solver/conjugate_gradients.hpp"
#include "solver/not_positive_definite.hpp"

namespace perilink {
namespace {

/// Compliance of a load along opened elements, over that of a single element, above which the body
/// does not resist it.
constexpr double no_resistance = 1e12;

}  // namespace

void ContactChanges::settle(EventOutcome& outcome, double direction) {
  begin();
  follow_broken();
  ContactRounds rounds(contact_, direction);
  std::vector<Index> wrong = rounds.next();
  while (!wrong.empty() && !outcome.mechanism) {
    if (!follow(wrong, outcome)) {
      // Only round-off violates elements that alone hold a part without load.
      wrong = contact_.violated(
          {direction, contact_.round_off_of(contact_.deciding_motion({direction, 0.0}))});
      if (wrong.empty()) break;
      const std::vector<Index> others = take_over(wrong);
      outcome.mechanism = others.empty() || !follow(others, outcome);
    }
    wrong = rounds.next();
  }
  if (!outcome.mechanism) set_closed_ratios(opened());
}

/// Returns the elements that were closed before the last call of settle() and are open now.
std::vector<Index> ContactChanges::opened() const {
  std::set<Index> opened;
  for (const Index element : changed_) {
    if (!opened.erase(element)) opened.insert(element);
  }
  std::erase_if(opened, [&](Index element) { return body_.is_closed(element); });
  return {opened.begin(), opened.end()};
}

/// Sets the closed stiffness of broken bonds. Bonds that carry pressure, or would at once, keep
/// theirs, so that no energy appears.
void ContactChanges::set_closed_ratios(std::span<const Index> bonds) {
  for (const auto& [bond, ratio] : body_.faces().ratios_of(bonds)) {
    if (body_.is_closed(bond) || contact_.extension_of(bond).now < 0.0) continue;
    ratios_before_.emplace_back(bond, body_.faces().set_closed_ratio(bond, ratio));
  }
}

/// Finds an open element that can hold what a violated closed element alone holds. Once the closed
/// one is open, nothing resists the motion K^-1 x that stretches it, and the energy falls along
/// this motion until another element closes. If none does, the body separates.
/// \return the element that closes and the one that opens; empty if no element closes
std::vector<Index> ContactChanges::take_over(const std::vector<Index>& wrong) {
  const Unknowns& unknowns = body_.unknowns();
  for (const Index element : wrong) {
    if (!body_.is_closed(element)) continue;
    const SparseVector x = body_.one_sided_removal(element).x[0];
    std::vector<double> values(body_.num_unknowns(), 0.0);
    for (int k = 0; k < x.size(); ++k) values[x.rows[k]] = x.values[k];
    solution_.update().inverse().solve(values, values);
    std::vector<double> motion = unknowns.expand(values);
    for (std::size_t k = 0; k < motion.size(); ++k) motion[k] -= unknowns.prescribed[k];
    const Index other = contact_.first_closed_by(motion);
    if (other != no_index) return {other, element};
  }
  return {};
}

void ContactChanges::turn(const std::vector<Index>& elements) {
  for (const Index element : elements) body_.turn(element);
}

void ContactChanges::take_back() {
  turn(changed_);
  for (const auto& [bond, ratio] : ratios_before_) body_.faces().set_closed_ratio(bond, ratio);
  begin();
}

void ContactChanges::close(Index element) {
  // Before the stiffness changes.
  solution_.update().inverse().update(body_.one_sided_removal(element).x[0]);
  body_.turn(element);
}

bool ContactChanges::open(Index element) {
  const Removal removal = body_.one_sided_removal(element);
  Factor& inverse = solution_.update().inverse();
  const double pivot = inverse.pivot(removal.x[0]);
  if (pivot > uncertain_pivot) {
    body_.turn(element);
    inverse.downdate(removal.vectors(), removal.load_changes(), {&pivot, 1}, {});
    return true;
  }
  const double kept = body_.secants()[element];
  if (separation_.resistance(removal.x[0], element, kept).first == 0.0) {
    body_.turn(element);
    return false;
  }
  try {
    solution_.renew();
    return true;
  } catch (const NotPositiveDefinite&) {
    body_.turn(element);
    solution_.renew();
    return false;
  }
}

/// Changes all contact states at once, with one new K^-1.
/// \return false if elements that open held the body; then all is unchanged
bool ContactChanges::change_together(const std::vector<Index>& wrong) {
  turn(wrong);
  try {
    solution_.renew();
    if (holds_apart(wrong)) return true;
  } catch (const NotPositiveDefinite&) {
  }
  turn(wrong);
  solution_.renew();
  return false;
}

/// Returns whether the body resists where elements have opened. If only round-off resists a motion,
/// the work of forces along these elements is too large. Forces of different sizes move elements
/// apart in every motion in which some of them open.
bool ContactChanges::holds_apart(const std::vector<Index>& opened) {
  VariedForces forces(body_.num_unknowns());
  for (const Index element : opened) {
    if (!body_.is_closed(element)) forces.add(body_.one_sided_removal(element).x[0]);
  }
  std::vector<double> motion(forces.load.size(), 0.0);
  solution_.update().inverse().solve(forces.load, motion);
  const double work = scalar_product(forces.load, motion);
  return work >= 0.0 && work < no_resistance;
}

/// Changes contact states and finds the equilibrium by conjugate gradients.
/// \return false if they do not find it; then the states are unchanged
bool ContactChanges::search(const std::vector<Index>& wrong) {
  // Broken elements that open may free a part that the load does not move.
  const auto may_free = [&](Index e) { return body_.is_closed(e) && body_.secants()[e] == 0.0; };
  if (!solution_.update().searches() || std::ranges::any_of(wrong, may_free)) return false;
  turn(wrong);
  if (solution_.search()) return true;
  turn(wrong);
  return false;
}

/// Changes contact states in K^-1. Elements that close hold the body while others open.
/// \return elements that changed; none if the violated elements hold the body
std::vector<Index> ContactChanges::change(std::vector<Index> wrong) {
  solution_.bring_inverse_up();
  if (solution_.update().is_cheaper_anew(wrong.size()) && change_together(wrong)) return wrong;
  const auto opening = std::stable_partition(
      wrong.begin(), wrong.end(), [&](Index element) { return !body_.is_closed(element); });
  for (auto element = wrong.begin(); element != opening; ++element) close(*element);
  wrong.erase(std::remove_if(opening, wrong.end(), [&](Index element) { return !open(element); }),
              wrong.end());
  return wrong;
}

/// Adds the growth of f'u - R'd from one equilibrium to the other, u_1' (K_1 - K_2) u_2.
void ContactChanges::add_growth(Index element, const Extension& before,
                                EventOutcome& outcome) const {
  const Extension after = contact_.extension_of(element);
  const double lost = body_.network().stiffness[element] * body_.one_sided(element) *
                      (body_.is_closed(element) ? -1.0 : 1.0);
  outcome.compliance_growth += lost * before.growing * after.growing;
  outcome.permanent_growth.linear += 2.0 * lost * before.constant * after.growing;
  outcome.permanent_growth.constant += lost * before.constant * after.constant;
}

/// Changes contact states and finds equilibrium. Returns false if the violated elements hold the
/// body.
bool ContactChanges::follow(const std::vector<Index>& wrong, EventOutcome& outcome) {
  struct Before {
    Index element;
    Extension extension;
    bool closed;
  };
  std::vector<Before> before;
  for (const Index element : wrong) {
    before.push_back({element, contact_.extension_of(element), body_.is_closed(element)});
  }
  Update& update = solution_.update();
  const int factors = update.inverse().statistics().factorizations;
  const bool found = search(wrong);
  const std::vector<Index> changed = found ? wrong : change(wrong);
  if (changed.empty()) return false;
  changed_.insert(changed_.end(), changed.begin(), changed.end());
  std::erase_if(before,
                [&](const Before& bond) { return body_.is_closed(bond.element) == bond.closed; });
  if (!found && (!update.adds_solutions() || !solution_.growing().is_whole() ||
                 update.inverse().statistics().factorizations != factors)) {
    solution_.refresh();
  } else if (!found) {
    ForceOfElements forces(body_.num_unknowns());
    for (const auto& [element, extension, closed] : before) {
      const double root = std::sqrt(body_.network().stiffness[element] * body_.one_sided(element)) *
                          (closed ? 1.0 : -1.0);
      forces.add(body_.one_sided_removal(element).x[0], root * extension.growing,
                 root * extension.constant);
    }
    solution_.follow_forces(forces);
  }
  work_.sum_anew();
  for (const Before& bond : before) add_growth(bond.element, bond.extension, outcome);
  return true;
}

}  // namespace perilink
