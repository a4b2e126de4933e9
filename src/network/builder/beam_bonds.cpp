#include "network/builder/beam_bonds.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "network/bond_strength.hpp"
#include "network/builder/graded_stiffness.hpp"
#include "network/builder/softened_bonds.hpp"

namespace perilink {
namespace {

/// Bonds of a beam segment: their shares of the section, and the critical stretch.
class SpanBonds {
 public:
  SpanBonds(const BeamSpan& span, double step, double horizon)
      : step_(step),
        reach_(std::max<Index>(
            1, static_cast<Index>(std::floor(horizon * (1.0 + horizon_tolerance) / step)))),
        share_(2.0 / (static_cast<double>(reach_) * static_cast<double>(reach_ + 1))),
        missing_(static_cast<std::size_t>(span.last - span.first), 1.0),
        length_(missing_.size(), 0.0) {
    const Index parts = span.last - span.first;
    for (Index i = 0; i < parts; ++i) {
      for (Index j = i + 1; j <= std::min(parts, i + reach_); ++j) {
        for (Index part = i; part < j; ++part) {
          missing_[part] -= share_;
          length_[part] += share_ * static_cast<double>(j - i);
        }
      }
    }
    for (std::size_t part = 0; part < length_.size(); ++part) length_[part] += missing_[part];
  }

  Index reach() const { return reach_; }
  /// Returns the share of the bond between two particles, counted from the first of the beam
  /// segment (Be-2).
  double share(Index i, Index j) const { return share_ + (j == i + 1 ? missing_[i] : 0.0); }
  /// Returns the critical stretch for which all bonds across a section, with their shares, release
  /// G_F (Be-4). Sections near an end have shorter bonds in the mean; the shortest bond takes the
  /// rest.
  double critical_stretch(const SolidMaterial& material, Index i, Index j) const {
    const double length = (2.0 * static_cast<double>(reach_) + 1.0) / 3.0;
    const double square =
        2.0 * material.fracture_energy / (material.youngs_modulus * step_ * length);
    const bool shortest = j == i + 1 && length - length_[i] > 1e-9 * length;
    return std::sqrt(shortest ? square * (1.0 + (length - length_[i]) / share(i, j)) : square);
  }

 private:
  double step_;
  Index reach_;                  ///< longest bond over the shortest
  double share_;                 ///< share of a bond far from the ends
  std::vector<double> missing_;  ///< unassigned share between neighbours
  std::vector<double> length_;   ///< mean length of the bonds across each interval, over the step
};

}  // namespace

Network make_beam(const Body& body, const NetworkInput& input) {
  Network network;
  network.particles = body.particles;
  network.facets = body.facets;
  for (const BeamSpan& span : body.spans) {
    const SolidMaterial& material = input.materials[span.material];
    const double step =
        (body.particles.position(span.last)[0] - body.particles.position(span.first)[0]) /
        (span.last - span.first);
    const SpanBonds bonds(span, step, input.horizon);
    const double tension = material.youngs_modulus * span.height * input.thickness;
    for (Index i = span.first; i < span.last; ++i) {
      for (Index j = i + 1; j <= std::min(span.last, i + bonds.reach()); ++j) {
        network.bonds.append(network.particles, i, j);
        const double length = network.bonds.lengths.back();
        const Index from = i - span.first, to = j - span.first;
        const double stiffness = bonds.share(from, to) * tension / length;
        network.stiffness.push_back(stiffness);
        network.bending.push_back(stiffness * span.height * span.height / (length * length));
        add_critical_stretch(input, bonds.critical_stretch(material, from, to), network);
        network.half_height.push_back(0.5 * span.height);
      }
    }
  }
  network.first_slip_spring = network.first_embedded_slip_spring = network.first_bar_element =
      network.bonds.size();
  scale_stiffness(input, network);
  if (!input.elastic) soften_bonds(body, input, network);
  return network;
}

}  // namespace perilink
