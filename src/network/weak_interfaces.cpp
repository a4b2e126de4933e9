#include "network/weak_interfaces.hpp"

#include <algorithm>
#include <cmath>
#include <span>

#include "discretization/cuts/cracks.hpp"
#include "material/critical_stretch.hpp"
#include "material/principal_values.hpp"
#include "network/bond_softening.hpp"

namespace perilink {
namespace {

/// Bonds of the solid that cross the face, without those that pre-cracks have cut.
std::vector<Index> crossing_bonds(const Body& body, const WeakInterface& face,
                                  const Network& network) {
  std::vector<Index> crossing;
  std::vector<std::uint8_t> keep;
  if (face.side.empty()) {
    keep = find_cut_bonds(network.particles, network.bonds, {&face.face, 1}, body.lattice.spacing)
               .keep;
  }
  const auto side = [&](Index i) {
    return i < static_cast<Index>(face.side.size()) ? face.side[i] : 0;
  };
  for (Index e = 0; e < network.num_bonds(); ++e) {
    const bool crosses = face.side.empty()
                             ? keep[e] == 0
                             : side(network.bonds.first[e]) + side(network.bonds.second[e]) == 3;
    const std::vector<Index>& cut = network.cut_elements;
    if (crosses && !std::binary_search(cut.begin(), cut.end(), e)) crossing.push_back(e);
  }
  return crossing;
}

/// Particles on the surface and those bonded to them.
std::vector<std::uint8_t> near_surface(const Network& network) {
  std::vector<std::uint8_t> at(static_cast<std::size_t>(network.particles.size()), 0);
  for (Index f = 0; f < network.facets.size(); ++f) {
    if (!network.facets.on_surface(f)) continue;
    for (const Index i : network.facets.corners.row(f)) at[i] = 1;
  }
  std::vector<std::uint8_t> near = at;
  for (Index e = 0; e < network.first_tie; ++e) {
    if (at[network.bonds.first[e]] != 0) near[network.bonds.second[e]] = 1;
    if (at[network.bonds.second[e]] != 0) near[network.bonds.first[e]] = 1;
  }
  return near;
}

/// Sum of k xi^2 of the bonds through a unit area of the face [force/length].
double fracture_sum(const Network& network, std::span<const Index> crossing) {
  const auto count = static_cast<std::size_t>(network.particles.size());
  const auto dim = static_cast<std::size_t>(network.dim());
  // The normal at a particle is the axis along which its crossing bonds lie most.
  std::vector<SymmetricTensor> axes(count, SymmetricTensor{});
  std::vector<std::uint8_t> beside(count, 0);
  for (const Index e : crossing) {
    Vector3 n{};
    std::copy_n(network.bonds.direction(e).begin(), dim, n.begin());
    for (const Index i : {network.bonds.first[e], network.bonds.second[e]}) {
      beside[i] = 1;
      for (int a = 0; a < 3; ++a) {
        axes[i][a] += n[a] * n[a];
        axes[i][3 + a] += n[a] * n[(a + 1) % 3];
      }
    }
  }
  const std::vector<std::uint8_t> outer = near_surface(network);
  bool any_inner = false;
  for (std::size_t i = 0; i < count; ++i) any_inner |= beside[i] != 0 && outer[i] == 0;
  std::vector<Vector3> normal(count, Vector3{});
  double volume = 0.0, sum = 0.0;
  for (std::size_t i = 0; i < count; ++i) {
    if (any_inner && outer[i] != 0) beside[i] = 0;
    if (beside[i] == 0) continue;
    normal[i] = principal_direction(axes[i], network.dim());
    volume += network.particles.volumes[i];
  }
  for (Index e = 0; e < network.first_tie; ++e) {
    for (const Index i : {network.bonds.first[e], network.bonds.second[e]}) {
      if (beside[i] == 0) continue;
      double cosine = 0.0;
      for (std::size_t a = 0; a < dim; ++a) cosine += normal[i][a] * network.bonds.direction(e)[a];
      sum += 0.5 * network.stiffness[e] * std::pow(network.bonds.lengths[e], 3) * std::abs(cosine);
    }
  }
  return sum / volume;
}

/// Mean constants of the materials on both sides, with the law of the face.
SolidMaterial material_of(const WeakInterface& face, const NetworkInput& input,
                          const Network& network, std::span<const Index> crossing) {
  SolidMaterial mean;
  mean.fracture_energy = face.fracture_energy;
  mean.softening = face.softening;
  for (const Index e : crossing) {
    for (const Index i : {network.bonds.first[e], network.bonds.second[e]}) {
      const SolidMaterial& own = input.materials[network.particles.material[i]];
      const double part = 0.5 / static_cast<double>(crossing.size());
      mean.youngs_modulus += part * own.youngs_modulus;
      mean.poissons_ratio += part * own.poissons_ratio;
    }
  }
  return mean;
}

}  // namespace

void weaken_interfaces(const Body& body, const NetworkInput& input, Network& network) {
  for (std::size_t k = 0; k < input.interfaces.size(); ++k) {
    const WeakInterface& face = input.interfaces[k];
    const std::vector<Index> crossing = crossing_bonds(body, face, network);
    network.bonds_of_interface.push_back(static_cast<Index>(crossing.size()));
    if (crossing.empty() || input.draft) continue;
    const SolidMaterial material = material_of(face, input, network, crossing);
    const double brittle =
        lattice_critical_stretch(material.fracture_energy, fracture_sum(network, crossing));
    MaterialBonds bonds{BondLaw::brittle(), {}};
    bonds.strength.first_stretch = brittle;
    const bool softens = material.softening.shape.kind != Softening::brittle;
    if (softens || material.softening.closes) {
      try {
        bonds = bonds_of_material(body, input, material, brittle);
      } catch (const TooStrong& error) {
        throw TooStrong(static_cast<Index>(input.materials.size() + k), error.share);
      }
    }
    const auto law = static_cast<Index>(network.laws.size());
    network.laws.push_back(bonds.law);
    network.law_of.resize(network.stiffness.size(), 0);
    for (const Index e : crossing) {
      network.law_of[e] = law;
      network.critical_stretch[e] = softens ? bonds.strength.first_stretch : brittle;
    }
  }
}

}  // namespace perilink
