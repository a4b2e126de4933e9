#include "model/symmetry_damage.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "io/case/case_words.hpp"
#include "model/model_regions.hpp"
#include "network/bond_softening.hpp"

namespace perilink {
namespace {

std::vector<std::uint8_t> marked(Index count, std::span<const Index> members) {
  std::vector<std::uint8_t> marks(static_cast<std::size_t>(count), 0);
  for (const Index i : members) marks[i] = 1;
  return marks;
}

}  // namespace

std::optional<SymmetryDamage> damage_on_symmetry(const CaseFile& input, const Model& model,
                                                 const Secants& secants) {
  const Network& network = model.network;
  if (input.symmetry.empty() || network.critical_stretch.empty()) return std::nullopt;
  constexpr double steep = 0.5 - 1e-6;  // squared cosine of the angle between bond and normal
  std::vector<std::vector<std::uint8_t>> in_plane;
  for (std::size_t k = 0; k < input.symmetry.size(); ++k) {
    in_plane.push_back(marked(network.particles.size(), particles_of_plane(input, model, k)));
  }
  double all = 0.0;
  std::vector<double> along(in_plane.size(), 0.0);
  for (Index b = 0; b < network.num_bonds(); ++b) {
    const double secant = secants.least(b);
    if (secant == 1.0 || !network.has_limit(b)) continue;
    const double energy = dissipated_until(network, b, secant);
    all += energy;
    for (std::size_t k = 0; k < in_plane.size(); ++k) {
      const double normal = network.bonds.direction(b)[input.symmetry[k].axis];
      const bool leaves =
          in_plane[k][network.bonds.first[b]] != in_plane[k][network.bonds.second[b]];
      if (leaves && normal * normal >= steep) along[k] += energy;
    }
  }
  if (!(all > 0.0)) return std::nullopt;
  const auto most = std::ranges::max_element(along);
  return SymmetryDamage{static_cast<std::size_t>(most - along.begin()), *most / all};
}

std::optional<std::string> ligament_note(const CaseFile& input, const Model& model) {
  const Network& network = model.network;
  const Particles& particles = network.places();
  const double room = 1e-6 * model.lattice.spacing;
  for (std::size_t k = 0; k < input.symmetry.size() && !network.critical_stretch.empty(); ++k) {
    const int axis = input.symmetry[k].axis;
    const std::vector<Index> held = particles_of_plane(input, model, k);
    const std::vector<std::uint8_t> is_held = marked(particles.size(), held);
    const double at = particles.position(held.front())[axis];
    bool is_part = false, breaks = false;
    for (Index i = 0; i < particles.size(); ++i) {
      const bool is_solid = particles.kind[i] == ParticleKind::solid;
      const bool on_face = is_solid && std::abs(particles.position(i)[axis] - at) <= room;
      is_part = is_part || (on_face && is_held[i] == 0);
    }
    for (Index b = 0; b < network.num_bonds() && is_part; ++b) {
      const bool leaves = is_held[network.bonds.first[b]] != is_held[network.bonds.second[b]];
      breaks = breaks || (leaves && network.can_break(b));
    }
    if (!breaks) continue;
    return fmt::format(
        "symmetry[{}] holds a part of the face {} = {:.6g}, as beside a notch: a crack from the "
        "notch would run along the plane, where a half body takes the whole fracture energy, so "
        "that peak and energy are too high, by up to a factor of 2: model the whole body",
        k + 1, axis_names[axis], at);
  }
  return std::nullopt;
}

std::optional<std::string> warning_about_symmetry(const std::optional<SymmetryDamage>& damage) {
  constexpr double substantial = 0.35;
  if (!damage || damage->share < substantial) return std::nullopt;
  return fmt::format(
      "{:.2g} of the dissipated energy lies along the plane of symmetry of symmetry[{}]: a half "
      "body takes the whole fracture energy of a crack on its plane, so that peak and energy are "
      "too high, by up to a factor of 2; model the whole body",
      damage->share, damage->plane + 1);
}

}  // namespace perilink
