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

/// Contact spring before it is in the network.
struct Contact {
  Index particle;
  Vector3 normal;          ///< from the particle across the crack
  double stiffness = 0.0;  ///< [force/length]
  double arm = 0.0;        ///< sum of stiffness times distance across the crack [force]
  double distance() const { return arm / stiffness; }
};

/// Layers of particles across a crack are told apart by their distance in spacings, and pieces of
/// cracks by the components of their normals, in units that are far above round-off.
using Layer = std::tuple<Index, std::array<long, 3>, long>;

std::array<long, 3> rounded(const Vector3& normal) {
  std::array<long, 3> result{};
  for (int a = 0; a < 3; ++a) result[a] = std::lround(1e6 * normal[a]);
  return result;
}

/// Returns the contact springs of both sides, ordered by particle.
std::vector<Contact> contacts_of(const Network& network, double spacing,
                                 const std::vector<CutBond>& cut) {
  std::map<Layer, Contact> layers;
  const Particles& particles = network.particles;
  for (const CutBond& bond : cut) {
    double distance = 0.0;
    for (int a = 0; a < particles.dim; ++a) {
      distance +=
          bond.normal[a] * (particles.position(bond.second)[a] - particles.position(bond.first)[a]);
    }
    const long layer = std::max(1L, std::lround(distance / spacing));
    for (const auto& [particle, sign] : {std::pair(bond.first, 1.0), {bond.second, -1.0}}) {
      const Vector3 normal = {sign * bond.normal[0], sign * bond.normal[1], sign * bond.normal[2]};
      Contact& contact = layers[{particle, rounded(normal), layer}];
      contact.particle = particle;
      contact.normal = normal;
      contact.stiffness += 0.5 * bond.stiffness;
      contact.arm += 0.5 * bond.stiffness * distance;
    }
  }
  std::vector<Contact> contacts;
  for (const auto& [layer, contact] : layers) {
    if (contact.arm > 0.0) contacts.push_back(contact);
  }
  return contacts;
}

/// Particles around a point, as EmbeddedPoints has them.
struct Carriers {
  std::vector<Index> particles;
  std::vector<double> weights, strain_weights;
};

/// Returns the weights of the motion of a point and of the strain along the crack, from particles
/// that no crack parts from the point. Empty if these do not span a linear field.
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
  if (all.weights.empty()) return {};
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

void append(const Contact& contact, const Carriers& carriers, bool elastic, Network& network) {
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
  network.embedded_points.append(carriers.particles, carriers.weights, carriers.strain_weights,
                                 normal);
  network.bonds.append(contact.particle, particles.size() - 1, contact.distance(), normal);
  network.stiffness.push_back(contact.stiffness);
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
  const double spacing = body.lattice.spacing;
  const int dim = network.dim();
  const std::vector<Contact> contacts = contacts_of(network, spacing, closing.bonds);
  const CrackCutter cutter(closing.cracks, dim, spacing);
  const std::vector<ParticleKind>& kind = network.particles.kind;
  const auto num_solid =
      std::ranges::find_if(kind, [](ParticleKind k) { return k != ParticleKind::solid; }) -
      kind.begin();
  std::vector<double> points;
  for (const Contact& contact : contacts) {
    const Vector3 x = point_of(network.particles.positions, dim, contact.particle);
    for (int a = 0; a < dim; ++a) points.push_back(x[a] + contact.distance() * contact.normal[a]);
  }
  const Csr near = find_neighbors(
      std::span(network.particles.positions).first(static_cast<std::size_t>(num_solid) * dim),
      points, dim, embedded_point_reach * spacing);
  for (std::size_t k = 0; k < contacts.size(); ++k) {
    const Index particle = contacts[k].particle;
    const Vector3 point = point_of(points, dim, static_cast<Index>(k));
    const auto& [lambda, mu] =
        lame_constants(input, input.materials[network.particles.material[particle]]);
    const Carriers carriers =
        carriers_of(network.particles, near.row(static_cast<Index>(k)), point, contacts[k].normal,
                    contacts[k].distance() * lambda / (lambda + 2.0 * mu), cutter, spacing);
    if (!carriers.particles.empty()) append(contacts[k], carriers, input.elastic, network);
  }
  network.law_of.resize(network.stiffness.size() - static_cast<std::size_t>(network.num_contacts),
                        0);
  network.law_of.resize(network.stiffness.size(), static_cast<Index>(network.laws.size()));
  network.laws.push_back(BondLaw::brittle().closing());
}

}  // namespace perilink
