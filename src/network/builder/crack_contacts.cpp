#include "network/builder/crack_contacts.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <span>
#include <tuple>

#include "discretization/cuts/cracks.hpp"
#include "discretization/facet_geometry.hpp"
#include "discretization/mesh_faces.hpp"
#include "discretization/neighbor_search.hpp"
#include "network/bond_strength.hpp"

namespace perilink {
namespace {

/// Particles around a point, as EmbeddedPoints has them.
struct Carriers {
  std::vector<Index> particles;
  std::vector<double> weights, strain_weights;
};

/// Contact spring before it is in the network.
struct Contact {
  Index particle;
  Vector3 normal;          ///< from the particle across the crack
  double stiffness = 0.0;  ///< of the bonds to the layer [force/length]
  double arm = 0.0;        ///< sum of stiffness times distance across the crack [force]
  double share = 0.0;      ///< stiffness of the spring [force/length]
  /// Factor on it: where one particle moves the point, no strain along the crack is known, and the
  /// slice behind the crack is free to the sides.
  double softer = 1.0;
  Carriers carriers = {};  ///< of its point across the crack

  double distance() const { return arm / stiffness; }
};

/// Layers of particles across a crack are told apart by their distance in spacings, and pieces of
/// cracks by the components of their normals, in units that are far above round-off.
using Layer = std::tuple<Index, std::array<long, 3>, long>;
using Contacts = std::map<Layer, Contact>;

std::array<long, 3> rounded(const Vector3& normal) {
  std::array<long, 3> result{};
  for (int a = 0; a < 3; ++a) result[a] = std::lround(1e6 * normal[a]);
  return result;
}

/// Returns the contact springs of the two ends of a cut bond.
std::array<Contact*, 2> contacts_of(const Particles& particles, double spacing, const CutBond& bond,
                                    Contacts& contacts) {
  double distance = 0.0;
  for (int a = 0; a < particles.dim; ++a) {
    distance +=
        bond.normal[a] * (particles.position(bond.second)[a] - particles.position(bond.first)[a]);
  }
  const long layer = std::max(1L, std::lround(distance / spacing));
  std::array<Contact*, 2> own{};
  for (const int end : {0, 1}) {
    const double sign = end == 0 ? 1.0 : -1.0;
    const Index particle = end == 0 ? bond.first : bond.second;
    const Vector3 normal = {sign * bond.normal[0], sign * bond.normal[1], sign * bond.normal[2]};
    const auto [at, is_new] =
        contacts.try_emplace({particle, rounded(normal), layer}, Contact{particle, normal});
    own[end] = &at->second;
  }
  for (Contact* contact : own) {
    contact->stiffness += bond.stiffness;
    contact->arm += bond.stiffness * distance;
  }
  return own;
}

/// Returns the weights of the motion of a point and of the strain along the crack, from particles
/// that no crack parts from the point. If these do not span a linear field, a particle at the point
/// moves it alone.
/// \return empty if there is no such particle either
/// \param normal  of the crack
/// \param reach   distance over which the strain counts [length]
Carriers carriers_of(const Particles& particles, std::span<const Index> near, const Vector3& point,
                     const Vector3& normal, double reach, const CrackCutter& cutter,
                     double spacing) {
  constexpr double same_place = 1e-6;
  const int dim = particles.dim;
  std::vector<double> arms;
  Carriers all;
  std::optional<std::size_t> here;
  for (const Index i : near) {
    const Vector3 x = point_of(particles.positions, dim, i);
    if (cutter.cuts(point, x)) continue;
    const Vector3 arm = minus(x, point);
    if (norm(arm) < same_place * spacing) here = all.particles.size();
    all.particles.push_back(i);
    arms.insert(arms.end(), arm.begin(), arm.begin() + dim);
  }
  all.weights = linear_weights(arms, dim, spacing);
  if (all.weights.empty()) {
    if (!here) return {};
    return {{all.particles[*here]}, {1.0}, std::vector<double>(static_cast<std::size_t>(dim), 0.0)};
  }
  std::vector<std::vector<double>> gradient;
  for (int a = 1; a <= dim; ++a) gradient.push_back(linear_weights(arms, dim, spacing, a));
  Carriers carriers;
  for (std::size_t k = 0; k < all.weights.size(); ++k) {
    double along = 0.0;
    bool counts = all.weights[k] != 0.0;
    for (int a = 0; a < dim; ++a) {
      along += normal[a] * gradient[a][k];
      counts = counts || gradient[a][k] != 0.0;
    }
    if (!counts) continue;  // beyond the reach of the weights
    carriers.particles.push_back(all.particles[k]);
    carriers.weights.push_back(!here ? all.weights[k] : *here == k ? 1.0 : 0.0);
    for (int a = 0; a < dim; ++a) {
      carriers.strain_weights.push_back(reach * (gradient[a][k] - along * normal[a]));
    }
  }
  return carriers;
}

/// Finds the particles that move the points of all contact springs.
void find_carriers(const Body& body, const NetworkInput& input, const CrackCutter& cutter,
                   const Particles& particles, Contacts& contacts) {
  const double spacing = body.lattice.spacing;
  const int dim = particles.dim;
  const auto num_solid =
      std::ranges::find_if(particles.kind,
                           [](ParticleKind kind) { return kind != ParticleKind::solid; }) -
      particles.kind.begin();
  std::vector<double> points;
  for (const auto& [layer, contact] : contacts) {
    const Vector3 x = point_of(particles.positions, dim, contact.particle);
    for (int a = 0; a < dim; ++a) points.push_back(x[a] + contact.distance() * contact.normal[a]);
  }
  const Csr near = find_neighbors(
      std::span(particles.positions).first(static_cast<std::size_t>(num_solid) * dim), points, dim,
      embedded_point_reach * spacing);
  Index row = 0;
  for (auto& [layer, contact] : contacts) {
    const auto& [lambda, mu] =
        lame_constants(input, input.materials[particles.material[contact.particle]]);
    const double ratio = lambda / (lambda + 2.0 * mu);
    contact.carriers = carriers_of(particles, near.row(row), point_of(points, dim, row),
                                   contact.normal, contact.distance() * ratio, cutter, spacing);
    if (contact.carriers.particles.size() == 1) {
      contact.softer =
          (1.0 - ratio) * (dim == 2 ? 1.0 + ratio : (1.0 + 2.0 * ratio) / (1.0 + ratio));
    }
    ++row;
  }
}

void append(const Contact& contact, bool elastic, Network& network) {
  Particles& particles = network.particles;
  const auto dim = static_cast<std::size_t>(particles.dim);
  const Vector3 x = point_of(particles.positions, particles.dim, contact.particle);
  const auto normal = std::span(contact.normal).first(dim);
  for (std::size_t a = 0; a < dim; ++a) {
    particles.positions.push_back(x[a] + contact.distance() * normal[a]);
  }
  particles.volumes.push_back(particles.volumes[contact.particle]);
  particles.material.push_back(no_index);
  particles.kind.push_back(ParticleKind::embedded_point);
  const Carriers& carriers = contact.carriers;
  network.embedded_points.append(carriers.particles, carriers.weights, carriers.strain_weights,
                                 normal);
  network.bonds.append(contact.particle, particles.size() - 1, contact.distance(), normal);
  network.stiffness.push_back(contact.softer * contact.share);
  if (!elastic) network.critical_stretch.push_back(infinity);
  ++network.num_contacts;
}

}  // namespace

CutBond cut_bond(const Network& network, Index bond, const Vector3& normal) {
  double along = 0.0;
  for (int a = 0; a < network.dim(); ++a) along += normal[a] * network.bonds.direction(bond)[a];
  const double sign = along < 0.0 ? -1.0 : 1.0;
  const double shear = network.bending.empty() ? 0.0 : network.bending[bond];
  return {network.bonds.first[bond],
          network.bonds.second[bond],
          {sign * normal[0], sign * normal[1], sign * normal[2]},
          network.stiffness[bond] * along * along + shear * (1.0 - along * along)};
}

void add_contacts(const Body& body, const NetworkInput& input, const ClosingCracks& closing,
                  Network& network) {
  if (closing.bonds.empty()) return;
  Contacts contacts;
  std::vector<std::array<Contact*, 2>> of_bonds;
  for (const CutBond& bond : closing.bonds) {
    of_bonds.push_back(contacts_of(network.particles, body.lattice.spacing, bond, contacts));
  }
  find_carriers(body, input, CrackCutter(closing.cracks, network.dim(), body.lattice.spacing),
                network.particles, contacts);
  // The spring of one end takes all of a bond whose other end has none, as across thin slices.
  for (std::size_t k = 0; k < of_bonds.size(); ++k) {
    const auto both = std::ranges::count_if(
        of_bonds[k], [](const Contact* contact) { return !contact->carriers.particles.empty(); });
    for (Contact* contact : of_bonds[k])
      contact->share += closing.bonds[k].stiffness / static_cast<double>(both);
  }
  for (const auto& [layer, contact] : contacts) {
    if (!contact.carriers.particles.empty()) append(contact, input.elastic, network);
  }
  const std::size_t count = network.stiffness.size();
  network.law_of.resize(count - static_cast<std::size_t>(network.num_contacts), 0);
  network.law_of.resize(count, static_cast<Index>(network.laws.size()));
  network.laws.push_back(BondLaw::brittle().closing());
}

}  // namespace perilink
