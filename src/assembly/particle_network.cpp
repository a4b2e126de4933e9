#include "assembly/particle_network.hpp"

#include <algorithm>
#include <limits>
#include <utility>
#include <vector>

#include "discretization/neighbor_search.hpp"
#include "discretization/outside_bonds.hpp"
#include "discretization/voronoi.hpp"

namespace perilink {
namespace {

/// Second neighbours are farther than this times the farthest one: in the face-centred lattice
/// those at sqrt(2) spacings, the farthest, but not those at one.
constexpr double far_from = 0.85;
constexpr double tie = 1e-6;  ///< of distances

/// Pairs of which at least one is a neighbour of the other, with whose neighbour is whose.
struct Pairs {
  Bonds bonds;
  std::vector<std::uint8_t> state_of;
};

Pairs find_pairs(const Particles& particles, std::span<const double> radius) {
  const Csr around =
      find_neighbors_within(particles.positions, particles.positions, particles.dim, radius);
  std::vector<std::pair<std::pair<Index, Index>, std::uint8_t>> halves;
  for (Index i = 0; i < particles.size(); ++i) {
    for (const Index j : around.row(i)) {
      if (j == i) continue;
      halves.push_back({{std::min(i, j), std::max(i, j)}, i < j ? first_end : second_end});
    }
  }
  std::sort(halves.begin(), halves.end());
  Pairs pairs;
  pairs.bonds.dim = particles.dim;
  for (std::size_t k = 0; k < halves.size(); ++k) {
    if (k > 0 && halves[k].first == halves[k - 1].first) {
      pairs.state_of.back() |= halves[k].second;
      continue;
    }
    pairs.bonds.append(particles, halves[k].first.first, halves[k].first.second);
    pairs.state_of.push_back(halves[k].second);
  }
  return pairs;
}

/// Takes out the pairs that see each other only through the outside of the body.
void remove_pairs_outside(const Body& body, Pairs& pairs) {
  Bonds inside = pairs.bonds;
  remove_bonds_outside(body.particles, inside, body.facets, body.lattice.spacing);
  std::size_t kept = 0;
  for (Index e = 0; e < pairs.bonds.size() && kept < inside.first.size(); ++e) {
    if (pairs.bonds.first[e] != inside.first[kept] || pairs.bonds.second[e] != inside.second[kept])
      continue;
    pairs.state_of[kept++] = pairs.state_of[e];
  }
  pairs.state_of.resize(kept);
  pairs.bonds = std::move(inside);
}

/// A neighbour's bond, outwards.
struct Member {
  Index element = 0;
  FamilyBond bond;
};

std::vector<std::vector<Member>> families_of(const Pairs& pairs, Index size) {
  std::vector<std::vector<Member>> families(static_cast<std::size_t>(size));
  for (Index e = 0; e < pairs.bonds.size(); ++e) {
    const auto n = pairs.bonds.direction(e);
    FamilyBond bond;
    bond.length = pairs.bonds.lengths[e];
    std::copy(n.begin(), n.end(), bond.direction.begin());  // signs do not matter: products n n'
    if ((pairs.state_of[e] & first_end) != 0) {
      families[pairs.bonds.first[e]].push_back({e, bond});
    }
    if ((pairs.state_of[e] & second_end) != 0) {
      families[pairs.bonds.second[e]].push_back({e, bond});
    }
  }
  for (auto& family : families) {
    double farthest = 0.0;
    for (const Member& member : family) farthest = std::max(farthest, member.bond.length);
    for (Member& member : family) member.bond.far = member.bond.length > far_from * farthest;
  }
  return families;
}

void note(const ParticleFit& fit, Index particle, ParticleFitReport& report) {
  switch (fit.kind) {
    case FitKind::exact: ++report.exact; break;
    case FitKind::least: ++report.least; break;
    case FitKind::many: ++report.many; break;
    case FitKind::indefinite: ++report.indefinite; break;
    case FitKind::singular: ++report.singular; break;
  }
  report.mean_residual += fit.residual;
  if (report.worst != no_index && !(fit.residual > report.largest_residual)) return;
  report.largest_residual = fit.residual;
  report.worst = particle;
}

}  // namespace

ParticleNetwork make_particle_network(const Body& body, Problem problem,
                                      std::span<const IsotropicMaterial> materials,
                                      double thickness) {
  const int dim = body.particles.dim;
  const int count = dim == 2 ? neighbors_in_plane : neighbors_in_space;
  std::vector<double> radius = distances_of_nearest(body.particles.positions, dim, count);
  for (double& r : radius) r *= 1.0 + tie;
  Pairs pairs = find_pairs(body.particles, radius);
  remove_pairs_outside(body, pairs);

  ParticleNetwork result;
  Network& network = result.network;
  network.particles = body.particles;
  network.particles.volumes = voronoi_volumes(body.particles, body.cells, thickness);
  network.facets = body.facets;
  network.bonds = std::move(pairs.bonds);
  network.state_of = std::move(pairs.state_of);
  const auto elements = static_cast<std::size_t>(network.bonds.size());
  network.stiffness.assign(elements, 0.0);
  network.critical_stretch.assign(elements, std::numeric_limits<double>::infinity());
  network.first_tie = network.first_segment = network.bonds.size();
  const Index size = network.particles.size();
  const auto families = families_of({network.bonds, network.state_of}, size);
  std::vector<FamilyBond> family;
  for (Index i = 0; i < size; ++i) {
    family.clear();
    for (const Member& member : families[i]) family.push_back(member.bond);
    const IsotropicMaterial& material = materials[network.particles.material[i]];
    const ParticleFit fit =
        fit_particle_moduli(problem, material.youngs_modulus, material.poissons_ratio, family,
                            network.particles.volumes[i]);
    note(fit, i, result.report);
    for (const Member& member : families[i]) {
      const double own = fit.moduli.own + (member.bond.far ? fit.moduli.far : 0.0);
      network.stiffness[member.element] += 0.5 * own / member.bond.length;
    }
    network.state_stiffness.push_back(0.5 * fit.moduli.state);
  }
  result.report.mean_residual /= std::max<Index>(1, size);
  return result;
}

}  // namespace perilink
