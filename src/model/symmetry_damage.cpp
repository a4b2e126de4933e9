#include "model/symmetry_damage.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <vector>

#include "model/model_regions.hpp"
#include "network/bond_softening.hpp"

namespace perilink {
namespace {

/// Returns the energy that a bond has dissipated [force length].
double dissipated(const Network& network, const Secants& secants, Index bond) {
  const double secant = secants.least(bond);
  if (secant == 1.0 || !network.has_limit(bond)) return 0.0;
  const double extension = network.critical_stretch[bond] * network.bonds.length(bond);
  return 0.5 * network.stiffness[bond] * extension * extension *
         energy_until(network.law(bond), secant);
}

}  // namespace

std::optional<SymmetryDamage> damage_on_symmetry(const CaseFile& input, const Model& model,
                                                 const Secants& secants) {
  const Network& network = model.network;
  if (input.symmetry.empty() || network.critical_stretch.empty()) return std::nullopt;
  constexpr double steep = 0.5;  // squared cosine of the angle between bond and normal
  std::vector<std::vector<std::uint8_t>> in_plane;
  for (std::size_t k = 0; k < input.symmetry.size(); ++k) {
    in_plane.emplace_back(static_cast<std::size_t>(network.particles.size()), 0);
    for (const Index i : particles_of_plane(input, model, k)) in_plane[k][i] = 1;
  }
  double all = 0.0;
  std::vector<double> along(in_plane.size(), 0.0), dbg1(in_plane.size(), 0.0), dbg2(in_plane.size(), 0.0);
  for (Index b = 0; b < network.num_bonds(); ++b) {
    const double energy = dissipated(network, secants, b);
    all += energy;
    for (std::size_t k = 0; energy > 0.0 && k < in_plane.size(); ++k) {
      const double normal = network.bonds.direction(b)[input.symmetry[k].axis];
      const int ends = in_plane[k][network.bonds.first[b]] + in_plane[k][network.bonds.second[b]];
      if (ends == 1 && normal * normal >= steep) along[k] += energy;
      if (ends == 1) dbg1[k] += energy;
      if (ends == 1) dbg2[k] += energy*normal*normal;
    }
  }
  if (!(all > 0.0)) return std::nullopt;
  SymmetryDamage most;
  for (std::size_t k = 0; k < along.size(); ++k) {
    if (std::getenv("SYMDBG")) fmt::print("SYM {} all {:.5g}: 45deg {:.3f} one-end {:.3f} n2 {:.3f}\n", k+1, all, along[k]/all, dbg1[k]/all, dbg2[k]/all);
    if (along[k] / all > most.share) most = {k, along[k] / all};
  }
  return most;
}

std::optional<std::string> warning_about_symmetry(const std::optional<SymmetryDamage>& damage) {
  constexpr double substantial = 0.3;
  if (!damage || damage->share < substantial) return std::nullopt;
  return fmt::format(
      "{:.2g} of the dissipated energy lies along the plane of symmetry of symmetry[{}]: a half "
      "body takes the whole fracture energy of a crack on its plane, so that peak and energy are "
      "too high, by up to a factor of 2; model the whole body",
      damage->share, damage->plane + 1);
}

}  // namespace perilink
