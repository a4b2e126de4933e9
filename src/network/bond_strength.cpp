#include "network/bond_strength.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <numeric>
#include <span>
#include <tuple>

#include "base/csr.hpp"
#include "material/critical_stretch.hpp"

namespace perilink {
namespace {

/// Sums over the inner particles of an unstructured particle set and the bond ends there.
struct InnerBonds {
  double volume = 0.0;
  double axial = 0.0;    ///< k xi^3 / 2
  double bending = 0.0;  ///< k_b / bending_ratio xi^3 / 2

  InnerBonds operator+(const InnerBonds& other) const {
    return {volume + other.volume, axial + other.axial, bending + other.bending};
  }
};

/// Maps a bond to the number of its pair of materials.
class PairOf {
 public:
  PairOf(const NetworkInput& input, const Network& network)
      : network_(network), count_(input.materials.size()) {}
  std::size_t operator()(Index bond) const {
    const auto [a, b] = materials_of_bond(network_, bond);
    return static_cast<std::size_t>(a) * count_ + static_cast<std::size_t>(b);
  }

 private:
  const Network& network_;
  std::size_t count_;
};

/// Flags particles without a bond to a particle on a facet.
std::vector<std::uint8_t> inner_particles(const Network& network) {
  std::vector<std::uint8_t> inner(static_cast<std::size_t>(network.particles.size()), 1);
  std::vector<std::uint8_t> on_facet(inner.size(), 0);
  for (const Index i : network.facets.corners.values) on_facet[i] = 1;
  for (Index b = 0; b < network.bonds.size(); ++b) {
    const Index i = network.bonds.first[b], j = network.bonds.second[b];
    if (on_facet[i] || on_facet[j]) inner[i] = inner[j] = 0;
  }
  return inner;
}

/// Returns the sums per material.
std::vector<InnerBonds> sum_inner_bonds(const Network& network, std::size_t num_materials) {
  const std::vector<std::uint8_t> inner = inner_particles(network);
  const std::vector<Index>& material = network.particles.material;
  std::vector<InnerBonds> sums(num_materials);
  for (Index i = 0; i < network.particles.size(); ++i) {
    if (inner[i]) sums[material[i]].volume += network.particles.volumes[i];
  }
  for (Index b = 0; b < network.bonds.size(); ++b) {
    const double cube = std::pow(network.bonds.length(b), 3);
    const bool bends = network.carries_moments() && network.bending_ratio[b] > 0.0;
    const double bending = bends ? network.bending[b] / network.bending_ratio[b] : 0.0;
    for (const Index i : {network.bonds.first[b], network.bonds.second[b]}) {
      if (!inner[i]) continue;
      sums[material[i]].axial += 0.5 * network.stiffness[b] * cube;
      sums[material[i]].bending += 0.5 * bending * cube;
    }
  }
  return sums;
}

/// Sets the critical stretches of bonds from fracture sums.
/// \param fracture_sums  Q of every pair of materials; zero: unknown
void apply_fracture_sums(const NetworkInput& input, const std::vector<double>& fracture_sums,
                         Network& network) {
  std::vector<double> stretches;
  for (const SolidMaterial& a : input.materials) {
    for (const SolidMaterial& b : input.materials) {
      const double energy = energy_between(a, b);
      const double sum = fracture_sums[stretches.size()];
      stretches.push_back(sum > 0.0 ? lattice_critical_stretch(energy, sum) : 0.0);
    }
  }
  const PairOf pair(input, network);
  for (Index b = 0; b < network.bonds.size(); ++b) {
    const double stretch = stretches[pair(b)];
    if (stretch > 0.0) network.critical_stretch[b] = stretch;
  }
}

/// Returns the key by which strengths of materials are compared.
auto strength_of(const SolidMaterial& material) {
  const SofteningMaterial& softening = material.softening;
  return std::tuple(material.fracture_energy, softening.tensile_strength, softening.stretches,
                    softening.shape.kind);
}

/// Returns whether a facet lies between breakable materials of different strength.
bool is_joint(const NetworkInput& input, const Facets& facets, Index facet) {
  if (facets.on_surface(facet)) return false;
  const SolidMaterial& inside = input.materials[facets.inside[facet]];
  const SolidMaterial& outside = input.materials[facets.outside[facet]];
  return std::isfinite(inside.fracture_energy) && std::isfinite(outside.fracture_energy) &&
         strength_of(inside) != strength_of(outside);
}

/// Returns the material of a facet that a direction enters, or the weaker one for a direction
/// within the facet's plane.
Index material_entered(const NetworkInput& input, const Facets& facets, Index facet,
                       std::span<const double> direction, double sign) {
  constexpr double in_plane = 1e-6;
  const auto area = facets.area_vector(facet);
  const double along = std::inner_product(area.begin(), area.end(), direction.begin(), 0.0);
  const double size = std::inner_product(area.begin(), area.end(), area.begin(), 0.0);
  const Index inside = facets.inside[facet], outside = facets.outside[facet];
  if (std::abs(along) > in_plane * std::sqrt(size)) return sign * along > 0.0 ? outside : inside;
  const bool first = strength_of(input.materials[inside]) < strength_of(input.materials[outside]);
  return first ? inside : outside;
}

/// Returns the value of a property; infinity: the material does not have it.
double value_of(const SolidMaterial& material, VaryingProperty property) {
  switch (property) {
    case VaryingProperty::tensile_strength: return material.softening.tensile_strength;
    case VaryingProperty::fracture_energy: return material.fracture_energy;
    default: return material.youngs_modulus;
  }
}

}  // namespace

std::vector<double> factors_on(VaryingProperty property, const NetworkInput& input,
                               std::span<const PropertyField> of_fields, const Network& network) {
  const auto count = static_cast<std::size_t>(network.num_bonds());
  const Bonds& bonds = network.bonds;
  std::vector<std::vector<double>> fields(input.materials.size());  // per material that varies
  std::vector<double> values;
  for (const SolidMaterial& material : input.materials) {
    values.push_back(value_of(material, property));
  }
  for (const PropertyField& field : of_fields) {
    if (field.property != property) continue;
    const Particles& places = network.places();
    const std::vector<double> own =
        factors_between(field, places.positions, places.dim, std::span(bonds.first).first(count),
                        std::span(bonds.second).first(count));
    for (std::size_t m = 0; m < fields.size(); ++m) {
      if (field.varies[m] == 0) continue;
      fields[m].resize(count, 1.0);
      std::ranges::transform(fields[m], own, fields[m].begin(), std::multiplies<>());
    }
  }
  std::vector<double> factors;
  for (std::size_t b = 0; b < count; ++b) {
    auto [i, j] = materials_of_bond(network, static_cast<Index>(b));
    if (network.is_beam()) i = j;  // a particle between two spans belongs to the first one
    const auto factor = [&](Index m) { return fields[m].empty() ? 1.0 : fields[m][b]; };
    const double mean = std::min(values[i], values[j]);
    factors.push_back(
        std::isinf(mean) ? 1.0 : std::min(values[i] * factor(i), values[j] * factor(j)) / mean);
  }
  return factors;
}

BondFactors property_factors(const NetworkInput& input, const Network& network) {
  if (input.fields.empty()) return {};
  return {factors_on(VaryingProperty::tensile_strength, input, input.fields, network),
          factors_on(VaryingProperty::fracture_energy, input, input.fields, network),
          factors_on(VaryingProperty::youngs_modulus, input, input.fields, network)};
}

double energy_between(const SolidMaterial& a, const SolidMaterial& b) {
  const auto [least, most] = std::minmax(a.fracture_energy, b.fracture_energy);
  return std::isinf(most) ? most : least;
}

std::array<Index, 2> materials_of_bond(const Network& network, Index bond) {
  if (!network.materials_of.empty()) return network.materials_of[bond];
  const Index i = network.bonds.first[bond], j = network.bonds.second[bond];
  const std::vector<Index>& material = network.particles.material;
  const bool ghost = network.particles.kind[j] == ParticleKind::ghost;  // never first
  return {material[i], material[ghost ? i : j]};
}

void set_materials_at_joints(const NetworkInput& input, Network& network) {
  if (input.elastic || input.materials.size() < 2) return;
  const Facets& facets = network.facets;
  const Csr joints_at = sorted_into_rows(network.particles.size(), [&](const auto& add_to) {
    for (Index f = 0; f < facets.size(); ++f) {
      if (!is_joint(input, facets, f)) continue;
      for (const Index i : facets.corners.row(f)) add_to(i, f);
    }
  });
  if (joints_at.values.empty()) return;
  std::vector<std::array<Index, 2>> materials;
  for (Index b = 0; b < network.bonds.size(); ++b) {
    std::array<Index, 2> own = materials_of_bond(network, b);
    for (const bool second : {false, true}) {
      const auto joints = joints_at.row(second ? network.bonds.second[b] : network.bonds.first[b]);
      for (std::size_t k = 0; k < joints.size(); ++k) {
        const Index entered = material_entered(input, facets, joints[k], network.bonds.direction(b),
                                               second ? -1.0 : 1.0);
        const bool weaker =
            strength_of(input.materials[entered]) < strength_of(input.materials[own[second]]);
        if (k == 0 || weaker) own[second] = entered;
      }
    }
    materials.push_back(own);
  }
  network.materials_of = std::move(materials);
}

std::vector<double> own_bending_ratios(const Network& network) {
  std::vector<double> ratios;
  for (std::size_t b = 0; b < network.bending.size(); ++b) {
    ratios.push_back(network.ratio_of_bending(static_cast<Index>(b)));
  }
  return ratios;
}

void set_critical_stretches(const NetworkInput& input, const LatticeNeighbourhoods& neighbourhoods,
                            double cell_volume, Network& network) {
  const Index count = static_cast<Index>(input.materials.size());
  std::vector<double> sums, stiffness(neighbourhoods.offsets().size());
  for (Index a = 0; a < count; ++a) {
    for (Index b = 0; b < count; ++b) {
      for (std::size_t k = 0; k < stiffness.size(); ++k) {
        stiffness[k] =
            0.5 * (neighbourhoods.stiffness(a).axial[k] + neighbourhoods.stiffness(b).axial[k]);
      }
      sums.push_back(fracture_sum_of_neighbourhood(input.problem, neighbourhoods.offsets(),
                                                   stiffness, cell_volume));
    }
  }
  apply_fracture_sums(input, sums, network);
}

void set_strength_of_unstructured(const NetworkInput& input, Network& network) {
  const std::vector<InnerBonds> inner = sum_inner_bonds(network, input.materials.size());
  std::vector<double> fracture_sums, factors;
  for (const InnerBonds& a : inner) {
    for (const InnerBonds& b : inner) {
      const InnerBonds both = a + b;
      fracture_sums.push_back(
          both.volume > 0.0 ? mean_cosine(input.problem) * both.axial / both.volume : 0.0);
      factors.push_back(both.bending > 0.0 ? both.bending / both.axial : 1.0);
    }
  }
  apply_fracture_sums(input, fracture_sums, network);
  const PairOf pair(input, network);
  for (std::size_t b = 0; b < network.bending_ratio.size(); ++b) {
    network.bending_ratio[b] *= factors[pair(static_cast<Index>(b))];
  }
}

}  // namespace perilink
