#include "network/weak_interfaces.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>
#include <span>

#include "base/csr.hpp"
#include "discretization/cuts/cracks.hpp"
#include "material/critical_stretch.hpp"
#include "material/principal_values.hpp"
#include "network/bond_softening.hpp"

namespace perilink {
namespace {

/// A face is plane where so much of its area is seen along its mean normal.
constexpr double plane = 0.98;

/// Normals at single particles are those of so many rounds of neighbours across the face.
constexpr int rounds_of_spreading = 3;

/// Bonds of the solid that cross the face, without those that pre-cracks have cut.
std::vector<Index> crossing_bonds(const Body& body, const WeakInterface& face,
                                  const Network& network) {
  std::vector<Index> crossing;
  std::vector<std::uint8_t> keep;
  if (face.side.empty()) {
    keep = find_cut_bonds(network.particles, network.bonds, face.faces, body.lattice.spacing).keep;
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

Vector3 direction_of(const Network& network, Index bond) {
  Vector3 n{};
  const auto direction = network.bonds.direction(bond);
  std::copy(direction.begin(), direction.end(), n.begin());
  return n;
}

double cosine_between(const Vector3& a, const Vector3& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/// Where the bonds that cross lie: sums of n n.
using Axes = SymmetricTensor;

void add(const Axes& other, Axes& axes) {
  for (std::size_t a = 0; a < axes.size(); ++a) axes[a] += other[a];
}

/// What the bonds that cross a face make of it.
struct Face {
  double area = 0.0;          ///< [length^2]
  double fracture_sum = 0.0;  ///< sum of k xi^2 over the area, as held at the end [force/length]
  double held = 1.0;          ///< mean of held_at_the_end()
  Vector3 axis{};             ///< mean normal
  bool plane = false;
  std::array<double, 2> moduli{};  ///< mean E behind it and where the normal points
  SolidMaterial material;          ///< mean constants of both sides, with the law of the face
};

/// Parts of the materials that fill the face itself. Where particles on the facets between two
/// materials have bonds across, that is the one which these bonds enter there, whatever the
/// particles are made of: for its stress they are calibrated.
std::vector<double> parts_of_materials(const Body& body, const NetworkInput& input,
                                       const Network& network, std::span<const Index> crossing) {
  std::vector<double> ends(input.materials.size(), 0.0), gap = ends;
  for (const Index e : crossing) {
    for (const Index i : {network.bonds.first[e], network.bonds.second[e]}) {
      ends[network.particles.material[i]] += 0.5 / static_cast<double>(crossing.size());
    }
  }
  if (input.draft || body.lattice.surface != Surface::calibrated) return ends;
  const Facets& facets = network.facets;
  const Csr facets_at = sorted_into_rows(network.particles.size(), [&](const auto& add_to) {
    for (Index f = 0; f < facets.size(); ++f) {
      if (facets.on_surface(f) || facets.inside[f] == facets.outside[f]) continue;
      for (const Index i : facets.corners.row(f)) add_to(i, f);
    }
  });
  double sum = 0.0;
  for (const Index e : crossing) {
    const auto n = network.bonds.direction(e);
    for (const bool first : {true, false}) {
      for (const Index f :
           facets_at.row(first ? network.bonds.first[e] : network.bonds.second[e])) {
        const auto area = facets.area_vector(f);
        const double out = std::inner_product(n.begin(), n.end(), area.begin(), 0.0);
        gap[(out > 0.0) == first ? facets.outside[f] : facets.inside[f]] += std::abs(out);
        sum += std::abs(out);
      }
    }
  }
  if (sum == 0.0) return ends;
  for (double& part : gap) part /= sum;
  return gap;
}

/// Constants of what fills the face, and moduli beside it.
void mix(const NetworkInput& input, const Network& network, std::span<const Index> crossing,
         std::span<const double> parts, Face& face) {
  const double part = 1.0 / static_cast<double>(crossing.size());
  for (const Index e : crossing) {
    const bool along = cosine_between(face.axis, direction_of(network, e)) > 0.0;
    const auto modulus = [&](Index i) {
      return input.materials[network.particles.material[i]].youngs_modulus;
    };
    face.moduli[along ? 0 : 1] += part * modulus(network.bonds.first[e]);
    face.moduli[along ? 1 : 0] += part * modulus(network.bonds.second[e]);
  }
  for (std::size_t m = 0; m < parts.size(); ++m) {
    face.material.youngs_modulus += parts[m] * input.materials[m].youngs_modulus;
    face.material.poissons_ratio += parts[m] * input.materials[m].poissons_ratio;
  }
}

/// Axes at each particle with crossing bonds, those of particles around it along such bonds added.
std::map<Index, Axes> axes_of_face(const Network& network, std::span<const Index> crossing) {
  std::map<Index, Axes> axes;
  for (const Index e : crossing) {
    const auto [x, y, z] = direction_of(network, e);
    const Axes own{x * x, y * y, z * z, x * y, y * z, z * x};
    add(own, axes[network.bonds.first[e]]);
    add(own, axes[network.bonds.second[e]]);
  }
  for (int round = 0; round < rounds_of_spreading; ++round) {
    const std::map<Index, Axes> before = axes;
    for (const Index e : crossing) {
      const Index i = network.bonds.first[e], j = network.bonds.second[e];
      add(before.at(i), axes.at(j));
      add(before.at(j), axes.at(i));
    }
  }
  return axes;
}

/// What a bond of one holds when it breaks by an opening along the normal, over k xi^2 s_c^2 / 2.
/// Bonds that carry moments break by a ratio of k_b to k that calibration has left behind.
double held_at_the_end(const Network& network, Index bond, double cosine) {
  if (!network.carries_moments()) return 1.0;
  const double along = cosine * cosine, across = 1.0 - along;
  const double bending = network.bending[bond] / network.stiffness[bond];
  return (along + bending * across) / (along + network.ratio_of_bending(bond) * across);
}

/// A uniform dilatation of one brings a stress of dim lambda + 2 mu, which bonds carry across the
/// face by k xi: that settles the area that they carry. The normal where a bond crosses is the axis
/// along which the bonds at its ends lie most.
Face measure(const Body& body, const NetworkInput& input, const Network& network,
             std::span<const Index> crossing) {
  const int dim = network.dim();
  const std::vector<double> parts = parts_of_materials(body, input, network, crossing);
  double stress = 0.0;
  for (std::size_t m = 0; m < parts.size(); ++m) {
    const LameConstants own = lame_constants(input, input.materials[m]);
    stress += parts[m] * (dim * own.lambda + 2.0 * own.mu);
  }
  const std::map<Index, Axes> axes = axes_of_face(network, crossing);
  Axes mean{};
  for (const auto& own : axes) add(own.second, mean);
  Face face;
  face.axis = principal_direction(mean, dim);
  double along = 0.0, fracture_along = 0.0;  // the same seen along the mean normal
  double squares = 0.0;
  for (const Index e : crossing) {
    const Index i = network.bonds.first[e], j = network.bonds.second[e];
    Axes both = axes.at(i);
    add(axes.at(j), both);
    const Vector3 n = direction_of(network, e);
    const double length = network.bonds.length(e);
    const double area = network.stiffness[e] * length / stress;
    const double square = network.stiffness[e] * length * length;
    const double own = std::abs(cosine_between(n, principal_direction(both, dim)));
    const double by_mean = std::abs(cosine_between(n, face.axis));
    face.area += area * own;
    along += area * by_mean;
    squares += square;
    face.fracture_sum += square * held_at_the_end(network, e, own);
    fracture_along += square * held_at_the_end(network, e, by_mean);
  }
  face.plane = along > plane * face.area;
  if (face.plane) {
    face.area = along;
    face.fracture_sum = fracture_along;
  }
  face.held = face.fracture_sum / squares;
  face.fracture_sum /= face.area;
  mix(input, network, crossing, parts, face);
  return face;
}

MaterialBonds bonds_of(const Body& body, const NetworkInput& input, const Face& face) {
  const double own = face.material.youngs_modulus;
  FaceShape shape{std::nullopt, {face.moduli[0] / own, face.moduli[1] / own}, face.held};
  if (face.plane) shape.normal = face.axis;
  return bonds_of_face(body, input, shape, face.material,
                       lattice_critical_stretch(face.material.fracture_energy, face.fracture_sum));
}

}  // namespace

void weaken_interfaces(const Body& body, const NetworkInput& input, Network& network) {
  for (std::size_t k = 0; k < input.interfaces.size(); ++k) {
    const WeakInterface& section = input.interfaces[k];
    const std::vector<Index> crossing = crossing_bonds(body, section, network);
    InterfaceBonds& own = network.interfaces.emplace_back();
    own.count = static_cast<Index>(crossing.size());
    if (crossing.empty()) continue;
    Face face = measure(body, input, network, crossing);
    face.material.fracture_energy = section.fracture_energy;
    face.material.softening = section.softening;
    own.area = face.area;
    try {
      const MaterialBonds bonds = bonds_of(body, input, face);
      own.strength = bonds.strength;
      network.law_of.resize(network.stiffness.size(), 0);
      for (const Index e : crossing) {
        network.law_of[e] = static_cast<Index>(network.laws.size());
        network.critical_stretch[e] = bonds.strength.first_stretch;
      }
      network.laws.push_back(bonds.law);
    } catch (const TooStrong& error) {
      throw TooStrong(static_cast<Index>(input.materials.size() + k), error.share);
    }
  }
}

}  // namespace perilink
