#include "network/correction/tied_strength.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

namespace perilink {
namespace {

/// Rounds of corrections; each removes most of the remaining deficits.
constexpr int rounds = 200;

/// Cuts in each spacing of particles.
constexpr int cuts_in_spacing = 2;

/// Factors on stretches are multiples of this: every stretch of softening bonds needs its own law.
constexpr double steps = 0.01;

/// Energies and forces of cuts along one tied face.
class CutsAlongFace {
 public:
  /// \param inwards  1 where the layer lies above the face, -1 below
  CutsAlongFace(const Joint& joint, double face, double inwards, double horizon, double spacing,
                const Network& network)
      : joint_(joint),
        face_(face),
        inwards_(inwards),
        step_(spacing / cuts_in_spacing),
        count_(static_cast<std::size_t>(std::ceil((horizon + spacing) / step_))),
        network_(network),
        energy_(count_ * (count_ + 1), 0.0),
        factor_(energy_.size(), 1.0),
        wanted_(count_, 0.0) {}

  /// \param share  fraction of each bond that is used: a half for each end away from other faces
  /// \param per_force  energy over force of a cut inside the layer [length]
  void measure(const std::vector<double>& share, double per_force);
  void even_out();
  double factor(Index bond) const {
    const auto [from, to] = crossed(bond);
    return from < to ? factor_[slot(from, to)] : 1.0;
  }

 private:
  struct Range {
    std::size_t from, to;
  };
  std::size_t slot(std::size_t from, std::size_t to) const { return from * (count_ + 1) + to; }
  double depth(Index particle) const {
    return inwards_ * (joint_.height(network_.particles.position(particle)) - face_);
  }
  Range crossed(Index bond) const;

  const Joint& joint_;
  double face_, inwards_, step_;
  std::size_t count_;
  const Network& network_;
  std::vector<double> energy_;  // k xi^2 of bonds across the same cuts, by first and last cut
  std::vector<double> factor_;  // factor on the stretch
  std::vector<double> wanted_;  // per cut
};

/// Returns the cuts that a bond crosses; cuts are at (k + 1/2) steps of depth.
CutsAlongFace::Range CutsAlongFace::crossed(Index bond) const {
  const double a = depth(network_.bonds.first[bond]), b = depth(network_.bonds.second[bond]);
  const auto first_below = [&](double at) {
    return static_cast<std::size_t>(
        std::clamp(std::ceil(at / step_ - 0.5), 0.0, static_cast<double>(count_)));
  };
  return {first_below(std::min(a, b)), first_below(std::max(a, b))};
}

void CutsAlongFace::measure(const std::vector<double>& share, double per_force) {
  for (Index b = 0; b < network_.bonds.size(); ++b) {
    const auto [from, to] = crossed(b);
    if (from >= to) continue;
    const double force = share[b] * network_.stiffness[b] * network_.bonds.length(b);
    const double rise = depth(network_.bonds.second[b]) - depth(network_.bonds.first[b]);
    energy_[slot(from, to)] += force * network_.bonds.length(b);
    for (std::size_t k = from; k < to; ++k) {
      wanted_[k] += force * std::abs(rise) / network_.bonds.length(b) * per_force;
    }
  }
}

/// Raises the energy of bonds that cross cuts with a deficit.
void CutsAlongFace::even_out() {
  std::vector<double> lack(count_);
  for (int round = 0; round < rounds; ++round) {
    std::fill(lack.begin(), lack.end(), 0.0);
    for (std::size_t from = 0; from < count_; ++from) {
      for (std::size_t to = from + 1; to <= count_; ++to) {
        const double energy = factor_[slot(from, to)] * energy_[slot(from, to)];
        for (std::size_t k = from; k < to; ++k) lack[k] += energy;
      }
    }
    for (std::size_t k = 0; k < count_; ++k) {
      lack[k] = lack[k] > 0.0 ? std::log(wanted_[k] / lack[k]) : 0.0;
    }
    for (std::size_t from = 0; from < count_; ++from) {
      double sum = 0.0;
      for (std::size_t to = from + 1; to <= count_; ++to) {
        sum += lack[to - 1];
        double& factor = factor_[slot(from, to)];
        factor = std::max(1.0, factor * std::exp(sum / static_cast<double>(to - from)));
      }
    }
  }
}

/// Marks particles on facets, on tied ones only with `tied_too`, and particles bonded to them.
std::vector<std::uint8_t> near_facets(const Network& network, bool tied_too) {
  std::vector<std::uint8_t> on_facet(static_cast<std::size_t>(network.particles.size()), 0);
  for (Index f = 0; f < network.facets.size(); ++f) {
    if (network.facets.is_tied(f) && !tied_too) continue;
    for (const Index i : network.facets.corners.row(f)) on_facet[i] = 1;
  }
  std::vector<std::uint8_t> near = on_facet;
  for (Index b = 0; b < network.bonds.size(); ++b) {
    if (on_facet[network.bonds.first[b]] != 0) near[network.bonds.second[b]] = 1;
    if (on_facet[network.bonds.second[b]] != 0) near[network.bonds.first[b]] = 1;
  }
  return near;
}

/// Returns the fraction of each bond: a half for each end that is not near.
std::vector<double> far_shares(const Network& network, const std::vector<std::uint8_t>& near) {
  std::vector<double> share;
  for (Index b = 0; b < network.bonds.size(); ++b) {
    share.push_back((near[network.bonds.first[b]] == 0 ? 0.5 : 0.0) +
                    (near[network.bonds.second[b]] == 0 ? 0.5 : 0.0));
  }
  return share;
}

/// Returns energy over force of a cut inside the layer, averaged over its height; zero without
/// interior.
double energy_per_force(const Joint& joint, const Network& network) {
  const std::vector<double> share = far_shares(network, near_facets(network, true));
  double energy = 0.0, force = 0.0;
  for (Index b = 0; b < network.bonds.size(); ++b) {
    const double length = network.bonds.length(b);
    const double rise = std::abs(joint.height(network.bonds.direction(b)));
    energy += share[b] * network.stiffness[b] * length * length * length * rise;
    force += share[b] * network.stiffness[b] * length * length * rise * rise;
  }
  return force > 0.0 ? energy / force : 0.0;
}

}  // namespace

void toughen_tied_faces(const Joint& joint, std::size_t layer, double horizon, double spacing,
                        Network& network) {
  const double per_force = energy_per_force(joint, network);
  if (!(per_force > 0.0)) return;
  const std::vector<double> share = far_shares(network, near_facets(network, false));
  const auto toughen = [&](double face, double inwards) {
    CutsAlongFace cuts(joint, face, inwards, horizon, spacing, network);
    cuts.measure(share, per_force);
    cuts.even_out();
    for (Index b = 0; b < network.bonds.size(); ++b) {
      const double factor = std::sqrt(cuts.factor(b));
      network.critical_stretch[b] *= steps * std::round(factor / steps);
    }
  };
  if (layer > 0) toughen(joint.planes[layer - 1], 1.0);
  if (layer < joint.planes.size()) toughen(joint.planes[layer], -1.0);
}

}  // namespace perilink
