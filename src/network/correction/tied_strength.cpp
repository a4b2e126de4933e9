#include "network/correction/tied_strength.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "base/joined_parts.hpp"
#include "discretization/facet_geometry.hpp"
#include "discretization/mesh_faces.hpp"
#include "discretization/neighbor_search.hpp"

namespace perilink {
namespace {

/// Rounds of corrections; each removes most of the remaining deficits.
constexpr int rounds = 200;

/// Cuts in each spacing of particles.
constexpr int cuts_in_spacing = 2;

/// Factors on stretches are multiples of this: every stretch of softening bonds needs its own law.
constexpr double steps = 0.01;

/// Energies and forces of cuts along one tied face, at constant distances from it.
class CutsAlongFace {
 public:
  /// \param depth  of each particle: distance from the face [length]
  CutsAlongFace(std::vector<double> depth, double horizon, double spacing, const Network& network)
      : depth_(std::move(depth)),
        step_(spacing / cuts_in_spacing),
        count_(static_cast<std::size_t>(std::ceil((horizon + spacing) / step_))),
        network_(network),
        energy_(count_ * (count_ + 1), 0.0),
        factor_(energy_.size(), 1.0),
        wanted_(count_, 0.0) {
    for (Index b = 0; b < network.bonds.size(); ++b) {
      if (const auto [from, to] = crossed(b); from < to) bonds_.push_back(b);
    }
  }

  /// \param share  fraction of each bond that is used: a half for each end away from other faces
  /// \param per_force  energy over force of a cut inside the part [length]
  void measure(const std::vector<double>& share, double per_force);
  void even_out();
  const std::vector<Index>& bonds() const { return bonds_; }  ///< that cross a cut
  /// \param bond  one of bonds()
  double factor(Index bond) const {
    const auto [from, to] = crossed(bond);
    return factor_[slot(from, to)];
  }

 private:
  struct Range {
    std::size_t from, to;
  };
  std::size_t slot(std::size_t from, std::size_t to) const { return from * (count_ + 1) + to; }
  Range crossed(Index bond) const;

  std::vector<double> depth_;
  double step_;
  std::size_t count_;
  const Network& network_;
  std::vector<Index> bonds_;
  std::vector<double> energy_;  // k xi^2 of bonds across the same cuts, by first and last cut
  std::vector<double> factor_;  // factor on the stretch
  std::vector<double> wanted_;  // per cut
};

/// Returns the cuts that a bond crosses; cuts are at (k + 1/2) steps of depth.
CutsAlongFace::Range CutsAlongFace::crossed(Index bond) const {
  const double a = depth_[network_.bonds.first[bond]], b = depth_[network_.bonds.second[bond]];
  const auto first_below = [&](double at) {
    return static_cast<std::size_t>(
        std::clamp(std::ceil(at / step_ - 0.5), 0.0, static_cast<double>(count_)));
  };
  return {first_below(std::min(a, b)), first_below(std::max(a, b))};
}

void CutsAlongFace::measure(const std::vector<double>& share, double per_force) {
  for (const Index b : bonds_) {
    const auto [from, to] = crossed(b);
    const double force = share[b] * network_.stiffness[b] * network_.bonds.length(b);
    const double rise = depth_[network_.bonds.second[b]] - depth_[network_.bonds.first[b]];
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

/// Returns energy over force of a cut inside the part, averaged over its place and over the
/// directions of tied facets; zero without interior.
double energy_per_force(const Network& network) {
  constexpr std::size_t most = 16;  // directions; more hardly change the mean
  std::vector<Index> tied;
  for (Index f = 0; f < network.facets.size(); ++f) {
    if (network.facets.is_tied(f)) tied.push_back(f);
  }
  std::vector<Vector3> normals;
  for (std::size_t k = 0; k < std::min(most, tied.size()); ++k) {
    const Index f = tied[k * tied.size() / std::min(most, tied.size())];
    normals.push_back(facet_geometry(network.particles, network.facets, f).normal);
  }
  const std::vector<double> share = far_shares(network, near_facets(network, true));
  double energy = 0.0, force = 0.0;
  for (Index b = 0; b < network.bonds.size(); ++b) {
    if (share[b] == 0.0) continue;
    const double length = network.bonds.length(b);
    const Vector3 direction = point_of(network.bonds.direction(b), network.dim(), 0);
    for (const Vector3& normal : normals) {
      const double rise = std::abs(dot(normal, direction));
      energy += share[b] * network.stiffness[b] * length * length * length * rise;
      force += share[b] * network.stiffness[b] * length * length * rise * rise;
    }
  }
  return force > 0.0 ? energy / force : 0.0;
}

/// Returns the tied facets of each face: facets that share particles belong to one face.
std::vector<std::vector<Index>> tied_faces(const Network& network) {
  const Facets& facets = network.facets;
  JoinedParts parts(network.particles.size());
  for (Index f = 0; f < facets.size(); ++f) {
    const auto corners = facets.corners.row(f);
    if (!facets.is_tied(f)) continue;
    for (const Index i : corners) parts.join(corners[0], i);
  }
  std::map<Index, std::vector<Index>> faces;
  for (Index f = 0; f < facets.size(); ++f) {
    if (facets.is_tied(f)) faces[parts.find(facets.corners.row(f)[0])].push_back(f);
  }
  std::vector<std::vector<Index>> result;
  for (auto& [part, face] : faces) result.push_back(std::move(face));
  return result;
}

/// Returns the distance of each particle from a face, at most `largest` [length].
std::vector<double> depths_below(const std::vector<Index>& face, double largest,
                                 const Network& network) {
  const Particles& particles = network.particles;
  std::vector<FacetGeometry> pieces;
  std::vector<double> first_corners;
  double size = 0.0;
  for (const Index f : face) {
    for (const FacetGeometry& piece : facet_pieces(particles, network.facets, f)) {
      first_corners.insert(first_corners.end(), piece.a.begin(), piece.a.begin() + particles.dim);
      size = std::max(size, piece.size);
      pieces.push_back(piece);
    }
  }
  // The nearest piece has its first corner within the distance of the nearest corner and its size.
  const NearestPoint corners(first_corners, particles.dim);
  std::vector<double> radii;
  for (Index i = 0; i < particles.size(); ++i) {
    const Vector3 x = point_of(particles.positions, particles.dim, i);
    const double distance = norm(minus(x, pieces[corners.at(particles.position(i))].a));
    radii.push_back(distance < largest + size ? distance + size : 0.0);
  }
  const Csr near = find_neighbors_within(first_corners, particles.positions, particles.dim, radii);
  std::vector<double> depth(radii.size(), largest);
  for (Index i = 0; i < particles.size(); ++i) {
    const Vector3 x = point_of(particles.positions, particles.dim, i);
    for (const Index k : near.row(i)) {
      depth[i] = std::min(depth[i], norm(minus(x, nearest_point(pieces[k], x))));
    }
  }
  return depth;
}

}  // namespace

void toughen_tied_faces(double horizon, double spacing, Network& network) {
  const double per_force = energy_per_force(network);
  if (!(per_force > 0.0)) return;
  const std::vector<double> share = far_shares(network, near_facets(network, false));
  for (const std::vector<Index>& face : tied_faces(network)) {
    CutsAlongFace cuts(depths_below(face, 2.0 * horizon + spacing, network), horizon, spacing,
                       network);
    cuts.measure(share, per_force);
    cuts.even_out();
    for (const Index b : cuts.bonds()) {
      const double factor = std::sqrt(cuts.factor(b));
      network.critical_stretch[b] *= steps * std::round(factor / steps);
    }
  }
}

}  // namespace perilink
