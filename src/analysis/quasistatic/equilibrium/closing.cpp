// Damaged bonds that close: of those whose law says so the ones in compression are as stiff against
// it as intact ones. The energy is convex and has one minimum; which bonds are closed there is
// found by changing the sides of those that are on the wrong one.

#include <fmt/format.h>
#include <cmath>

#include "analysis/quasistatic/equilibrium/equilibrium.hpp"
#include "base/error.hpp"
#include "solver/not_positive_definite.hpp"

namespace perilink {
namespace {

/// So often all bonds on the wrong side change it together, which ends after a round or two; from
/// then on the first one alone, which cannot go round in circles (Murty 1974).
constexpr int rounds_together = 10, most_rounds = 100000;

/// Extensions within round-off of the motion of the ends have no sign.
constexpr double round_off = 1e-14;

/// An opening bond with a smaller pivot held the last load path.
constexpr double no_pivot = 1e-12;

}  // namespace

/// Of an element; zero where it cannot be told from it.
auto Equilibrium::extension_of(Index element) const -> Extension {
  const auto width = static_cast<std::size_t>(network_.width());
  const std::size_t i = width * network_.bonds.first[element];
  const std::size_t j = width * network_.bonds.second[element];
  const std::span<const double> n = network_.bonds.direction(element);
  Extension result;
  double size = 0.0;
  const auto add = [&](const std::vector<double>& u, double factor, double& sum) {
    for (int a = 0; a < network_.dim(); ++a) {
      sum += n[a] * (u[j + a] - u[i + a]);
      size += std::abs(factor * n[a]) * (std::abs(u[j + a]) + std::abs(u[i + a]));
    }
  };
  const double load_factor = constant_ ? constant_->load_factor : 1.0;
  add(displacement_, load_factor, result.growing);
  if (constant_) add(constant_->displacement, 1.0, result.constant);
  const double now = load_factor * result.growing + result.constant;
  result.now = std::abs(now) > round_off * size ? now : 0.0;
  return result;
}

/// Whether a ground spring holds one of its ends where it came loose.
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

/// Closed bonds that are pulled and open ones that are compressed.
std::vector<Index> Equilibrium::on_wrong_side() const {
  std::vector<Index> wrong;
  for (const Index element : damaged_) {
    const double extension = extension_of(element).now;
    const bool wants_change = is_closed(element) ? extension > 0.0 : extension < 0.0;
    if (wants_change && (is_closed(element) || !is_grounded(element))) wrong.push_back(element);
  }
  return wrong;
}

/// \return false where nothing but the bond held the body: then all is as it was
bool Equilibrium::change_side(Index element) {
  const Removal axial = make_axial_removal(network_, *unknowns_, element, 1.0 - secants_[element]);
  const SparseVector& x = axial.x[0];
  if (!is_closed(element)) {
    axial_[element] = 1.0;
    if (x.size() > 0) factor_->update(x, solution_);
    return true;
  }
  const double pivot = x.size() > 0 ? factor_->prepare_downdate(x) : 1.0;
  axial_[element] = secants_[element];
  if (pivot > doubtful_pivot) {
    if (x.size() > 0) factor_->commit_downdate(axial.prescribed[0], solution_);
    return true;
  }
  try {
    if (!(pivot > no_pivot)) throw NotPositiveDefinite("a closed bond held the body last");
    factorize();
    return true;
  } catch (const NotPositiveDefinite&) {
    axial_[element] = 1.0;
    factorize();
    return false;
  }
}

/// f'u - R'd grows by u_1' (K_1 - K_2) u_2 from one equilibrium to the other.
void Equilibrium::add_growth(Index element, const Extension& before, EventOutcome& outcome) const {
  const Extension after = extension_of(element);
  const double lost =
      network_.stiffness[element] * (1.0 - secants_[element]) * (is_closed(element) ? -1.0 : 1.0);
  outcome.compliance_growth += lost * before.growing * after.growing;
  outcome.growth_beside.linear += 2.0 * lost * before.constant * after.growing;
  outcome.growth_beside.constant += lost * before.constant * after.constant;
}

void Equilibrium::settle_closing(EventOutcome& outcome) {
  for (int round = 0; round < most_rounds; ++round) {
    std::vector<Index> wrong = on_wrong_side();
    if (wrong.empty()) return;
    if (round >= rounds_together) wrong.erase(wrong.begin() + 1, wrong.end());
    std::vector<Extension> before;
    for (const Index element : wrong) before.push_back(extension_of(element));
    for (const Index element : wrong) {
      if (change_side(element)) continue;
      outcome.mechanism = true;
      return;
    }
    refresh();
    events_to_follow_ = 0;
    for (std::size_t k = 0; k < wrong.size(); ++k) add_growth(wrong[k], before[k], outcome);
  }
  throw SolverError(
      fmt::format("after {} changes it is not settled which of the damaged bonds are "
                  "closed",
                  most_rounds));
}

auto Equilibrium::next_side_change(double distance) const -> SideChange {
  SideChange next{no_index, distance};
  for (const Index element : damaged_) {
    const Extension extension = extension_of(element);
    const double growth = distance > 0.0 ? extension.growing : -extension.growing;
    if (!(is_closed(element) ? growth > 0.0 : growth < 0.0)) continue;
    if (!is_closed(element) && is_grounded(element)) continue;
    const double change = -extension.now / extension.growing;
    if (std::abs(change) < std::abs(next.distance)) next = {element, change};
  }
  return next;
}

EventOutcome Equilibrium::pass_side_change(Index element) {
  EventOutcome outcome;
  outcome.secant = 1.0;
  outcome.changed_side = true;
  const Extension before = extension_of(element);
  outcome.mechanism = !change_side(element);
  if (outcome.mechanism) return outcome;
  refresh();
  events_to_follow_ = 0;
  add_growth(element, before, outcome);
  settle_closing(outcome);
  return outcome;
}

/// Before the first event.
void Equilibrium::open_cut_elements() {
  if (damaged_.empty()) return;
  EventOutcome outcome;
  settle_closing(outcome);
  if (outcome.mechanism) {
    throw SolverError("the cracks have separated the body, and the loads pull it apart");
  }
}

}  // namespace perilink
