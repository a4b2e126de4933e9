#include "model/crack_shares.hpp"

#include <cmath>
#include <numbers>

#include "network/bond_softening.hpp"

namespace perilink {
std::vector<Gauge::CrackShare> crack_shares(const CaseFile& input, const Model& model,
                                            std::span<const std::uint8_t> marked) {
  const Network& network = model.network;
  const Particles& particles = network.particles;
  if (network.stiffness.empty() || network.critical_stretch.empty()) return {};
  double volume = 0.0, sum = 0.0;
  std::vector<double> modulus;  // [force/length^2]
  for (Index i = 0; i < particles.size(); ++i) {
    const Index material = particles.material[i];
    const bool is_solid = particles.kind[i] == ParticleKind::solid && material != no_index;
    if (is_solid) volume += particles.volumes[i];
    modulus.push_back(is_solid ? input.materials[material].youngs_modulus : 0.0);
    if (is_solid && !model.modulus.empty()) modulus.back() *= model.modulus[i];
  }
  std::vector<Gauge::CrackShare> shares;
  for (Index b = 0; b < network.num_bonds(); ++b) {
    const Index i = network.bonds.first[b], j = network.bonds.second[b];
    const double both = modulus[i] + modulus[j], length = network.bonds.length(b);
    if (!(both > 0.0)) continue;
    const double part = network.stiffness[b] / both * length * length;
    sum += part * length;
    const BondLaw& law = network.law(b);
    if (marked[i] == 0 || marked[j] == 0 || law.endless() || law.crushes()) continue;
    if (std::isfinite(network.critical_stretch[b])) {
      shares.push_back({b, part / energy_until(law, 0.0)});
    }
  }
  const bool in_space = input.body.problem == Problem::three_dimensional;
  const double mean = in_space ? 0.5 : 2.0 / std::numbers::pi;
  const double thickness = in_space ? 1.0 : input.body.thickness;
  for (Gauge::CrackShare& share : shares) share.size *= volume / (mean * sum * thickness);
  return shares;
}

double crack_size(const Network& network, std::span<const Gauge::CrackShare> shares,
                  const Secants& secants) {
  double size = 0.0;
  for (const auto& [bond, whole] : shares) {
    const double secant = secants.least(bond);
    if (secant < 1.0) size += whole * energy_until(network.law(bond), secant);
  }
  return size;
}

}  // namespace perilink
