#include "analysis/quasistatic/events/frame_limit_search.hpp"

#include <algorithm>
#include <cmath>

#include "analysis/quasistatic/events/block_search.hpp"
#include "analysis/quasistatic/events/limit_search.hpp"
#include "network/frame.hpp"

namespace perilink {
namespace {

/// Number of blocks below which one thread is faster.
constexpr Index fewest_parallel_frames = 100;

/// Axial over equivalent stretch above which a bond is in tension [-]. Where symmetry keeps the
/// length, round-off must not decide.
constexpr double least_tension = 1e-6;

/// Axial stretch over its limit above which a bond is in tension at given loads [-]: the value of
/// CrossingSearch and the round-off at the load factor where tension begins.
constexpr double least_tension_at_loads = 1e-6 + 1e-9;

}  // namespace

std::unique_ptr<BreakSearch> make_break_search(const Network& network, bool at_loads) {
  if (network.carries_moments()) return std::make_unique<FrameLimitSearch>(network, at_loads);
  return std::make_unique<LimitSearch>(network);
}

FrameLimitSearch::FrameLimitSearch(const Network& network, bool at_loads)
    : network_(network), dim_(network.dim()), torsion_(network.torsion), at_loads_(at_loads) {
  for (Index e = 0; e < network.num_elements(); ++e) {
    if (!network.has_limit(e)) continue;
    const double length = network.bonds.length(e);
    const Sense sense = network.law(e).sense();
    const double share = sense == Sense::each ? 0.0 : network.ratio_of_bending(e);
    Bond bond{network.bonds.first[e] * network.width(),
              network.bonds.second[e] * network.width(),
              {},
              network.inflection_of(e) * length,
              (1.0 - network.inflection_of(e)) * length,
              share,
              network.is_hinged(e) ? 0.0 : share * length * length / 12.0,
              inverse_of(e, network.critical_stretch[e] * network.law(e).segment(0).limit),
              0.0};
    if (sense == Sense::both) bond.compressed = bond.inverse;
    for (int a = 0; a < dim_; ++a) bond.n[a] = network.bonds.direction(e)[a];
    elements_.push_back(e);
    bonds_.push_back(bond);
  }
  block_largest_.resize(num_search_blocks(elements_.size()));
}

double FrameLimitSearch::inverse_of(Index element, double limit) const {
  const double length = network_.bonds.length(element);
  return std::isinf(limit) ? 0.0 : 1.0 / (length * limit * length * limit);
}

/// Returns the squared equivalent stretch over the limit in tension or in compression.
/// \param stretch  the largest of the bond, times its length; tension is positive
/// \param square   squared equivalent stretch times the squared length
double FrameLimitSearch::over_limit(const Bond& bond, double stretch, double square) const {
  const double tension = stretch * stretch;
  const bool counts = at_loads_
                          ? tension * bond.inverse > least_tension_at_loads * least_tension_at_loads
                          : tension > least_tension * least_tension * square;
  return square * (stretch > 0.0 && counts ? bond.inverse : bond.compressed);
}

template <int Dim>
double FrameLimitSearch::squared_ratio(const Bond& bond, const double* u) const {
  const FrameDeformation<Dim> d(bond.n, bond.first_arm, bond.second_arm, u + bond.first,
                                u + bond.second);
  double square = 0.0;
  if constexpr (Dim == 2) {
    square =
        bond.bending_share * d.shear[0] * d.shear[0] + bond.rotation_share * d.bend[0] * d.bend[0];
  } else {
    double shear_square = 0.0, bend_square = 0.0;
    for (int a = 0; a < 3; ++a) {
      shear_square += d.shear[a] * d.shear[a];
      bend_square += d.bend[a] * d.bend[a];
    }
    square = bond.bending_share * shear_square +
             bond.rotation_share * (bend_square + torsion_ * d.twist * d.twist);
  }
  square += d.extension * d.extension;
  return over_limit(bond, d.extension, square);
}

/// Returns the squared ratio of a shell or beam bond, which is in tension if one of its faces is.
template <int Dim>
double FrameLimitSearch::section_ratio(Index k, const double* u) const {
  const Bond& bond = bonds_[k];
  if constexpr (Dim == 3) return shell_bond_ratio(elements_[k], bond, u);
  const FrameDeformation<2> d(bond.n, bond.first_arm, bond.second_arm, u + bond.first,
                              u + bond.second);
  const double square = d.extension * d.extension + bond.bending_share * d.shear[0] * d.shear[0] +
                        bond.rotation_share * d.bend[0] * d.bend[0];
  // The shear force makes the moments at the ends differ.
  const double turn =
      std::abs(d.bend[0]) + 6.0 * std::abs(d.shear[0]) / (bond.first_arm + bond.second_arm);
  const double stretch = d.extension + network_.half_height[elements_[k]] * turn;
  return over_limit(bond, stretch, square);
}

double FrameLimitSearch::shell_bond_ratio(Index element, const Bond& bond, const double* u) const {
  const FrameModes<3> modes = frame_modes<3>(network_, element);
  const double ratio = network_.ratio_of_bending(element) * network_.stiffness[element];
  const double calibrated = network_.bending[element];
  double square = 0.0, stretch = 0.0;
  for (int m = 0; m < FrameModes<3>::count; ++m) {
    const double deformation = modes.deformation(m, u + bond.first, u + bond.second);
    const bool of_shear = m == 1 || m > 3;  // stiffness proportional to kb
    const double share = !of_shear        ? modes.stiffness[m]
                         : calibrated > 0 ? modes.stiffness[m] * ratio / calibrated
                                          : 0.0;
    square += share / network_.stiffness[element] * deformation * deformation;
    if (m == 0) stretch += deformation;
    if (m == 3) stretch += 0.5 * network_.shell->thickness * std::abs(deformation);
  }
  return over_limit(bond, stretch, square);
}

template <int Dim>
FrameLimitSearch::Hit FrameLimitSearch::find_in(const double* u, double tolerance, int threads) {
  const bool sections = network_.has_sections();
  const auto value_at = [&](Index k) {
    return sections ? section_ratio<Dim>(k, u) : squared_ratio<Dim>(bonds_[k], u);
  };
  const auto largest_in = [&](Index begin, Index end) {
    double largest = 0.0, zero_times_all = 0.0;
    for (Index k = begin; k < end; ++k) {
      const double value = value_at(k);
      largest = std::max(largest, value);
      zero_times_all += 0.0 * value;
    }
    return largest_or_nan(largest, zero_times_all);
  };
  Hit hit = find_first_largest(elements_, block_largest_, (1.0 - tolerance) * (1.0 - tolerance),
                               threads, fewest_parallel_frames, largest_in, value_at);
  hit.ratio = std::sqrt(hit.ratio);
  return hit;
}

FrameLimitSearch::Hit FrameLimitSearch::find(std::span<const double> displacement, double tolerance,
                                             int threads) {
  return dim_ == 3 ? find_in<3>(displacement.data(), tolerance, threads)
                   : find_in<2>(displacement.data(), tolerance, threads);
}

std::vector<FrameLimitSearch::Hit> FrameLimitSearch::list(std::span<const double> displacement,
                                                          double least) const {
  std::vector<Hit> hits;
  for (std::size_t k = 0; k < bonds_.size(); ++k) {
    const double* u = displacement.data();
    const auto place = static_cast<Index>(k);
    const double square = network_.shell       ? section_ratio<3>(place, u)
                          : network_.is_beam() ? section_ratio<2>(place, u)
                          : dim_ == 3          ? squared_ratio<3>(bonds_[k], u)
                                               : squared_ratio<2>(bonds_[k], u);
    const double ratio = finite_ratio(elements_[k], std::sqrt(square));
    if (ratio >= least) hits.push_back({elements_[k], ratio});
  }
  return hits;
}

void FrameLimitSearch::set_limit(Index element, double limit) {
  const auto found = std::lower_bound(elements_.begin(), elements_.end(), element);
  if (found == elements_.end() || *found != element) return;
  Bond& bond = bonds_[found - elements_.begin()];
  bond.inverse = inverse_of(element, limit);
  const bool none = std::isinf(limit);
  if (none || network_.law(element).sense() == Sense::both) bond.compressed = bond.inverse;
}

void FrameLimitSearch::set_limits(Index element, double tension, double compression) {
  set_limit(element, tension);
  const auto found = std::lower_bound(elements_.begin(), elements_.end(), element);
  bonds_[found - elements_.begin()].compressed = inverse_of(element, compression);
}

}  // namespace perilink
