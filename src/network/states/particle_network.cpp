#include "network/states/particle_network.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>
#include <vector>

#include "discretization/cuts/outside_bonds.hpp"
#include "discretization/neighbor_search.hpp"
#include "discretization/voronoi.hpp"

namespace perilink {
namespace {

/// Second neighbours are farther than this fraction of the farthest neighbour. In the face-centred
/// lattice these are at sqrt(2) spacings, the first at one.
constexpr double far_from = 0.85;
constexpr double tie = 1e-6;  ///< relative difference of distances that count as equal
/// Candidates per neighbour: slits remove some, and some neighbourhoods need more than the nearest.
constexpr int spare = 4;

/// Returns pairs close enough to be neighbours whose connection stays within the body.
Bonds find_candidates(const Body& body, int count) {
  const Particles& particles = body.particles;
  std::vector<double> radius =
      distances_of_nearest(particles.positions, particles.dim, spare * count);
  for (double& r : radius) r *= 1.0 + tie;
  const Csr around =
      find_neighbors_within(particles.positions, particles.positions, particles.dim, radius);
  std::vector<std::pair<Index, Index>> pairs;
  for (Index i = 0; i < particles.size(); ++i) {
    for (const Index j : around.row(i)) {
      if (j != i) pairs.emplace_back(std::min(i, j), std::max(i, j));
    }
  }
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  Bonds bonds;
  bonds.dim = particles.dim;
  for (const auto& [i, j] : pairs) bonds.append(particles, i, j);
  remove_bonds_outside(particles, bonds, body.facets, body.lattice.spacing);
  return bonds;
}

/// Neighbours of a particle among its candidates, and their constants.
struct Neighbourhood {
  std::vector<Index> elements;  ///< chosen candidates
  std::vector<NeighbourhoodBond> bonds;
  ParticleFit fit;
  bool enlarged = false;  ///< has more than the nearest neighbours, which left some strain free
};

class Neighbourhoods {
 public:
  Neighbourhoods(const Bonds& candidates, const Particles& particles, Problem problem,
                 std::span<const IsotropicMaterial> materials)
      : candidates_(candidates),
        particles_(particles),
        problem_(problem),
        materials_(materials),
        around_(bonds_of_particles(candidates, particles.size())),
        count_(particles.dim == 2 ? neighbors_in_plane : neighbors_in_space) {}

  Neighbourhood of(Index particle) const {
    std::vector<Index> nearest(around_.row(particle).begin(), around_.row(particle).end());
    std::stable_sort(nearest.begin(), nearest.end(), [&](Index a, Index b) {
      return candidates_.length(a) < candidates_.length(b);
    });
    Neighbourhood neighbourhood = of_nearest(particle, nearest, count_);
    for (std::size_t more = count_ + 1;
         neighbourhood.fit.kind == FitKind::singular && more <= nearest.size(); ++more) {
      neighbourhood = of_nearest(particle, nearest, more);
      neighbourhood.enlarged = true;
    }
    return neighbourhood;
  }

 private:
  /// Returns the nearest `count` candidates and all at the distance of the last one.
  Neighbourhood of_nearest(Index particle, std::span<const Index> nearest,
                           std::size_t count) const {
    Neighbourhood neighbourhood;
    if (!nearest.empty()) {
      const double last = candidates_.length(nearest[std::min(count, nearest.size()) - 1]);
      for (const Index e : nearest) {
        if (candidates_.length(e) > last * (1.0 + tie)) break;
        neighbourhood.elements.push_back(e);
        NeighbourhoodBond bond;
        bond.length = candidates_.length(e);
        bond.far = bond.length > far_from * last;
        const auto n = candidates_.direction(e);
        // Signs do not matter in the products n n'.
        std::copy(n.begin(), n.end(), bond.direction.begin());
        neighbourhood.bonds.push_back(bond);
      }
    }
    const Index number = particles_.material[particle];
    if (number == no_index) throw std::logic_error("a particle has no material");
    const IsotropicMaterial& material = materials_[number];
    neighbourhood.fit =
        fit_particle_moduli(problem_, material.youngs_modulus, material.poissons_ratio,
                            neighbourhood.bonds, particles_.volumes[particle]);
    return neighbourhood;
  }

  const Bonds& candidates_;
  const Particles& particles_;
  Problem problem_;
  std::span<const IsotropicMaterial> materials_;
  Csr around_;
  std::size_t count_;
};

void note(const Neighbourhood& neighbourhood, Index particle, ParticleFitReport& report) {
  const ParticleFit& fit = neighbourhood.fit;
  switch (fit.kind) {
    case FitKind::exact: ++report.exact; break;
    case FitKind::least: ++report.least; break;
    case FitKind::many: ++report.many; break;
    case FitKind::indefinite: ++report.indefinite; break;
    case FitKind::singular: ++report.singular; break;
  }
  report.enlarged += neighbourhood.enlarged ? 1 : 0;
  report.mean_residual += fit.residual;
  if (report.worst != no_index && !(fit.residual > report.largest_residual)) return;
  report.largest_residual = fit.residual;
  report.worst = particle;
}

/// Keeps candidates that are neighbours of at least one end, with their stiffness.
void keep_neighbours(const Bonds& candidates, std::span<const double> stiffness,
                     std::span<const std::uint8_t> state_of, Network& network) {
  network.bonds.dim = candidates.dim;
  for (Index e = 0; e < candidates.size(); ++e) {
    if (state_of[e] == 0) continue;
    network.bonds.append(network.particles, candidates.first[e], candidates.second[e]);
    network.stiffness.push_back(stiffness[e]);
    network.states->ends.push_back(state_of[e]);
  }
  network.first_slip_spring = network.first_bar_element = network.bonds.size();
}

}  // namespace

ParticleNetwork make_particle_network(const Body& body, Problem problem,
                                      std::span<const IsotropicMaterial> materials,
                                      double thickness) {
  ParticleNetwork result;
  Network& network = result.network;
  network.particles = body.particles;
  network.particles.volumes = voronoi_volumes(body.particles, body.cells, thickness);
  network.facets = body.facets;
  network.states.emplace();
  const int count = body.particles.dim == 2 ? neighbors_in_plane : neighbors_in_space;
  const Bonds candidates = find_candidates(body, count);
  const Neighbourhoods neighbourhoods(candidates, network.particles, problem, materials);
  std::vector<double> stiffness(static_cast<std::size_t>(candidates.size()), 0.0);
  std::vector<std::uint8_t> state_of(stiffness.size(), 0);
  const Index size = network.particles.size();
  for (Index i = 0; i < size; ++i) {
    const Neighbourhood neighbourhood = neighbourhoods.of(i);
    note(neighbourhood, i, result.report);
    for (std::size_t k = 0; k < neighbourhood.elements.size(); ++k) {
      const Index e = neighbourhood.elements[k];
      const double own = neighbourhood.fit.moduli.own +
                         (neighbourhood.bonds[k].far ? neighbourhood.fit.moduli.far : 0.0);
      stiffness[e] += 0.5 * own / neighbourhood.bonds[k].length;
      state_of[e] |= candidates.first[e] == i ? first_end : second_end;
    }
    network.states->stiffness.push_back(0.5 * neighbourhood.fit.moduli.state);
  }
  result.report.mean_residual /= std::max<Index>(1, size);
  keep_neighbours(candidates, stiffness, state_of, network);
  return result;
}

}  // namespace perilink
