#include "analysis/quasistatic/equilibrium/contact.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/error.hpp"
#include "network/unknowns.hpp"

namespace perilink {
namespace {

/// Rounds in which all violated elements change together before line searches, and most rounds.
constexpr int rounds_together = 10, most_rounds = 1000;

/// Fraction of the ends' motion below which an extension is round-off and has no sign [-].
constexpr double closing_round_off = 1e-11;

}  // namespace

/// Numbers on which all extensions depend.
struct Contact::View {
  const double* growing;
  const double* constant;  ///< null: no permanent loads
  double load_factor;
  double far;  ///< largest motion, if its errors spread to all particles [length]
  Reading reading;

  /// Computes an extension. If it is zero up to round-off, the direction of the load is decisive.
  template <int Dim>
  Extension extension(const UnilateralElement& bond) const {
    Extension result;
    double size = 0.0;
    const auto add = [&](const double* u, double factor, double& sum) {
      const double* const from = u + bond.first;
      const double* const to = u + bond.second;
      for (int a = 0; a < Dim; ++a) {
        sum += bond.n[a] * (to[a] - from[a]);
        size += std::abs(factor * bond.n[a]) * (std::abs(to[a]) + std::abs(from[a]));
      }
    };
    add(growing, load_factor, result.growing);
    if (constant != nullptr) add(constant, 1.0, result.constant);
    result.now = load_factor * result.growing + result.constant;
    const double noise = closing_round_off * (size + far) + reading.noise;
    if (std::abs(result.now) <= noise) result.now = 0.0;
    result.side = result.now != 0.0 ? result.now : reading.direction * result.growing;
    if (std::abs(result.side) <= reading.noise) result.side = 0.0;
    return result;
  }
};

auto Contact::view(const Reading& reading) const -> View {
  const Field& growing = solution_.growing().field();
  View view{growing.displacement.data(), nullptr, 1.0, 0.0, reading};
  const PermanentLoad* const permanent = solution_.permanent();
  if (permanent != nullptr) {
    view.constant = permanent->field().displacement.data();
    view.load_factor = permanent->load_factor();
  }
  if (!solution_.update().drift()) return view;
  view.far = std::abs(view.load_factor) * growing.largest_motion +
             (permanent != nullptr ? permanent->field().largest_motion : 0.0);
  return view;
}

/// Calls visit(element, extension) for all unilateral elements.
template <class Visit>
void Contact::for_each(const Reading& reading, Visit visit) const {
  const View now = view(reading);
  const bool in_space = body_.network().dim() == 3;
  for (const UnilateralElement& bond : body_.unilateral()) {
    if (!(body_.one_sided(bond.element) > 0.0)) continue;
    visit(bond.element, in_space ? now.extension<3>(bond) : now.extension<2>(bond));
  }
}

Extension Contact::extension_of(Index element, const Reading& reading) const {
  const UnilateralElement bond = body_.ends_of(element);
  const View now = view(reading);
  return body_.network().dim() == 2 ? now.extension<2>(bond) : now.extension<3>(bond);
}

std::vector<Index> Contact::violated(const Reading& reading) const {
  std::vector<Index> wrong;
  for_each(reading, [&](Index element, const Extension& extension) {
    const bool closed = body_.is_closed(element);
    const bool wants_change = closed ? extension.side > 0.0 : extension.side < 0.0;
    if (wants_change && (closed || !body_.is_grounded(element))) wrong.push_back(element);
  });
  return wrong;
}

auto Contact::next_change(double distance) const -> Change {
  Change next{no_index, distance};
  // ContactRounds leaves such elements as they are.
  const double noise = round_off_of(solution_.growing().field().displacement);
  for_each({}, [&](Index element, const Extension& extension) {
    if (std::max(std::abs(extension.now), std::abs(extension.growing)) <= noise) return;
    const double growth = std::copysign(1.0, distance) * extension.growing;
    if (!(body_.is_closed(element) ? growth > 0.0 : growth < 0.0)) return;
    if (!body_.is_closed(element) && body_.is_grounded(element)) return;
    const double change = -extension.now / extension.growing;
    if (std::abs(change) < std::abs(next.distance)) next = {element, change};
  });
  return next;
}

Index Contact::first_closed_by(std::span<const double> motion) const {
  constexpr double least_shortening = 1e-3;  // over the largest motion
  const double least = least_shortening * largest_displacement(body_.network(), motion);
  Index first = no_index;
  double shortest = std::numeric_limits<double>::infinity();
  for_each({}, [&](Index element, const Extension& extension) {
    if (body_.is_closed(element) || body_.is_grounded(element)) return;
    const UnilateralElement ends = body_.ends_of(element);
    double shortening = 0.0;
    for (int a = 0; a < body_.network().dim(); ++a) {
      shortening -= ends.n[a] * (motion[ends.second + a] - motion[ends.first + a]);
    }
    if (!(shortening > least)) return;
    const double way = std::max(extension.now, 0.0) / shortening;
    if (way < shortest) {
      shortest = way;
      first = element;
    }
  });
  return first;
}

double Contact::round_off_of(std::span<const double> motion) const {
  return closing_round_off * largest_displacement(body_.network(), motion);
}

std::vector<double> Contact::deciding_motion(const Reading& reading) const {
  std::vector<double> motion = solution_.growing().field().displacement;
  const PermanentLoad* const permanent = solution_.permanent();
  const double factor = reading.direction != 0.0 ? reading.direction
                        : permanent != nullptr   ? permanent->load_factor()
                                                 : 1.0;
  for (double& value : motion) value *= factor;
  if (reading.direction != 0.0 || permanent == nullptr) return motion;
  for (std::size_t k = 0; k < motion.size(); ++k) motion[k] += permanent->field().displacement[k];
  return motion;
}

/// Returns the extensions of unilateral elements in a motion, or zero if they cannot change now.
std::vector<double> Contact::extensions(std::span<const double> motion,
                                        const Reading& reading) const {
  std::vector<double> extensions;
  for (const UnilateralElement& bond : body_.unilateral()) {
    double sum = 0.0;
    for (int a = 0; a < body_.network().dim(); ++a) {
      sum += bond.n[a] * (motion[bond.second + a] - motion[bond.first + a]);
    }
    const bool fixed = !(body_.one_sided(bond.element) > 0.0) || body_.is_grounded(bond.element) ||
                       (reading.direction != 0.0 && extension_of(bond.element, reading).now != 0.0);
    extensions.push_back(fixed ? 0.0 : sum);
  }
  return extensions;
}

std::vector<Index> Contact::violated_by(std::span<const double> motion,
                                        const Reading& reading) const {
  const std::vector<double> values = extensions(motion, reading);
  std::vector<Index> wrong;
  for (std::size_t k = 0; k < values.size(); ++k) {
    const Index element = body_.unilateral()[k].element;
    if (body_.is_closed(element) ? values[k] > 0.0 : values[k] < 0.0) wrong.push_back(element);
  }
  return wrong;
}

/// The derivative at the fraction t of the way is
///
///   -(1 - t) q + sum over elements that changed state of +-k (1 - a) e(t) (e_to - e_from),
///
/// where q is twice the energy of the difference. The slope changes where an extension is zero.
double Contact::line_minimum(std::span<const double> from, std::span<const double> to,
                             const Reading& reading) const {
  const Network& network = body_.network();
  std::vector<double> difference(to.begin(), to.end());
  for (std::size_t k = 0; k < difference.size(); ++k) difference[k] -= from[k];
  double slope = 2.0 * internal_force(network, body_.secants(), difference).energy;
  double value = -slope;  // derivative at t = 0
  const std::vector<double> begin = extensions(from, reading), end = extensions(to, reading);
  std::vector<std::pair<double, double>> bends;  // position, and growth of the slope there
  for (std::size_t k = 0; k < begin.size(); ++k) {
    const double growth = end[k] - begin[k];
    const bool changes = begin[k] * end[k] < 0.0;
    if (!changes) continue;
    const Index element = body_.unilateral()[k].element;
    const double stiffness = network.stiffness[element] * body_.one_sided(element);
    const double sign = body_.is_closed(element) ? -1.0 : 1.0;
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

std::vector<Index> ContactRounds::next() {
  if (round_ == most_rounds) {
    throw SolverError(
        fmt::format("the contact states of damaged bonds do not settle in {} rounds", most_rounds));
  }
  const bool searches = round_ >= rounds_together, is_first_search = round_ == rounds_together;
  ++round_;
  Reading reading{direction_, 0.0};
  if (!searches) return contact_.violated(reading);
  const std::vector<double> aim = contact_.deciding_motion(reading);
  if (contact_.violated({direction_, contact_.round_off_of(aim)}).empty()) return {};
  if (is_first_search) reached_ = aim;
  const double part = is_first_search ? 1.0 : contact_.line_minimum(reached_, aim, reading);
  for (std::size_t k = 0; k < aim.size(); ++k) reached_[k] += part * (aim[k] - reached_[k]);
  return contact_.violated_by(reached_, reading);
}

}  // namespace perilink
