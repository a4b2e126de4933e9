#include "network/correction/surface_correction.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "base/timer.hpp"
#include "calibration/expected_calibration.hpp"
#include "calibration/kept/kept_calibration.hpp"
#include "network/bond_strength.hpp"
#include "network/correction/material_parts.hpp"
#include "network/correction/tied_strength.hpp"
#include "network/lattice_neighbourhoods.hpp"

namespace perilink {
namespace {

/// Returns 1/2 sum k xi^2 of the axial bonds of every particle [force length].
std::vector<double> moduli_of_particles(const Network& network, std::span<const double> stiffness) {
  std::vector<double> modulus(static_cast<std::size_t>(network.particles.size()), 0.0);
  for (Index b = 0; b < network.bonds.size(); ++b) {
    const double xi = network.bonds.length(b);
    modulus[network.bonds.first[b]] += 0.5 * stiffness[b] * xi * xi;
    modulus[network.bonds.second[b]] += 0.5 * stiffness[b] * xi * xi;
  }
  return modulus;
}

/// Returns the modulus per volume of an infinite body: the integral of c xi / 2 over the horizon.
double continuum_modulus(const NetworkInput& input, double micromodulus) {
  const double delta = input.horizon;
  if (dimension_of(input.problem) == 3) {
    return 0.5 * std::numbers::pi * micromodulus * std::pow(delta, 4);
  }
  return std::numbers::pi / 3.0 * micromodulus * input.thickness * std::pow(delta, 3);
}

/// Least number of neighbours to balance moments in space where a joint of parts meets the
/// surface: about three variables for each of the 18 equations of a particle. Cubic lattices with
/// horizons of two spacings have only 32.
constexpr std::size_t least_neighbours = 36;

/// Number of neighbours that is enough for thin layers. Cubic lattices of equal steps have 56 with
/// horizons of 2.24 spacings and 80 from 2.45 on. Face-centred lattices have 54 with two and 78
/// with 2.24.
constexpr Index enough_in_space = 78;

/// Whether the stretches of all bonds are given.
bool have_stretches(const NetworkInput& input) {
  return std::all_of(input.materials.begin(), input.materials.end(),
                     [](const SolidMaterial& m) { return m.softening.stretches[0] > 0.0; });
}

bool can_break(const NetworkInput& input) {
  return std::any_of(input.materials.begin(), input.materials.end(),
                     [](const SolidMaterial& m) { return std::isfinite(m.fracture_energy); });
}

class Correction {
 public:
  Correction(const Body& body, const NetworkInput& input, Network& network)
      : body_(body), input_(input), network_(network) {}

  void energy();
  /// \param give_up  see CalibrationInput::give_up
  void calibrate(bool give_up = false);
  bool calibrate_parts();
  void balance(const CalibrationInput& calibration);

 private:
  bool on_lattice() const { return body_.lattice.pattern != Pattern::irregular; }
  bool micropolar() const { return input_.model == BondModel::micropolar; }
  Index material(Index particle) const { return network_.particles.material[particle]; }
  void fade_at_horizon();
  void favor_short_bonds();
  void hinge();
  void set_strength(const LatticeNeighbourhoods* neighbourhoods);
  void take_bulk_neighbourhoods(const LatticeNeighbourhoods& neighbourhoods,
                                std::span<const Index> of_kinds);
  std::vector<double> wanted_moduli(const LatticeNeighbourhoods* neighbourhoods) const;
  void scale_to(const std::vector<double>& wanted, std::span<const std::uint8_t> free);
  std::vector<std::uint8_t> free_bonds(const LatticeNeighbourhoods& neighbourhoods,
                                       std::span<const Index> of_kinds) const;

  const Body& body_;
  const NetworkInput& input_;
  Network& network_;
};

/// Weights neighbours at the horizon by the part of their cells within it.
void Correction::fade_at_horizon() {
  for (Index b = 0; b < network_.bonds.size(); ++b) {
    const double part =
        partial_volume(network_.bonds.length(b), input_.horizon, body_.lattice.spacing);
    network_.stiffness[b] *= part;
    if (micropolar()) network_.bending[b] *= part;
  }
}

/// Sets stiffnesses proportional to 1/xi^(d+1), so that bonds of each length have the same part of
/// the energy. The error of the stiffness for waves is about half of that with 1/xi. Short bonds
/// would trap cracks (docs/theory/calibration.md).
void Correction::favor_short_bonds() {
  for (Index b = 0; b < network_.bonds.size(); ++b) {
    const double part = std::pow(input_.horizon / network_.bonds.length(b), network_.dim());
    network_.stiffness[b] *= part;
    if (micropolar()) network_.bending[b] *= part;
  }
}

/// Returns the neighbourhood of each translation class of bonds.
std::vector<Index> neighbourhoods_of_kinds(const LatticeNeighbourhoods& neighbourhoods,
                                           const Bonds& bonds) {
  std::vector<Index> result;
  result.reserve(bonds.lengths.size());
  for (Index k = 0; k < bonds.num_kinds(); ++k) {
    result.push_back(neighbourhoods.find(bonds.direction_of_kind(k), bonds.lengths[k]));
  }
  return result;
}

/// Sets the stiffness of the isotropic neighbourhoods, in proportion to the volumes of the ends.
void Correction::take_bulk_neighbourhoods(const LatticeNeighbourhoods& neighbourhoods,
                                          std::span<const Index> of_kinds) {
  const double volume = body_.lattice.cell_volume;
  for (Index e = 0; e < network_.bonds.size(); ++e) {
    const Index i = network_.bonds.first[e], j = network_.bonds.second[e];
    const Index k = of_kinds[network_.bonds.kind_of(e)];
    if (k == no_index) continue;
    const double share =
        network_.particles.volumes[i] / volume * (network_.particles.volumes[j] / volume);
    const NeighbourhoodStiffness& a = neighbourhoods.stiffness(material(i));
    const NeighbourhoodStiffness& b = neighbourhoods.stiffness(material(j));
    network_.stiffness[e] = 0.5 * (a.axial[k] + b.axial[k]) * share;
    if (micropolar()) network_.bending[e] = 0.5 * (a.bending[k] + b.bending[k]) * share;
  }
}

/// Returns moduli_of_particles() of interior particles.
std::vector<double> Correction::wanted_moduli(const LatticeNeighbourhoods* neighbourhoods) const {
  std::vector<double> per_volume;
  for (std::size_t m = 0; m < input_.materials.size(); ++m) {
    per_volume.push_back(
        neighbourhoods ? neighbourhoods->modulus(static_cast<Index>(m)) / body_.lattice.cell_volume
                       : continuum_modulus(
                             input_, moduli_of(body_, input_, input_.materials[m]).micromodulus));
  }
  std::vector<double> wanted(static_cast<std::size_t>(network_.particles.size()));
  for (Index i = 0; i < network_.particles.size(); ++i) {
    wanted[i] = per_volume[material(i)] * network_.particles.volumes[i];
  }
  return wanted;
}

/// \param free  bonds to scale; empty: all
void Correction::scale_to(const std::vector<double>& wanted, std::span<const std::uint8_t> free) {
  const std::vector<double> present = moduli_of_particles(network_, network_.stiffness);
  for (Index b = 0; b < network_.bonds.size(); ++b) {
    if (!free.empty() && !free[b]) continue;
    const Index i = network_.bonds.first[b], j = network_.bonds.second[b];
    const double factor = 0.5 * (wanted[i] / present[i] + wanted[j] / present[j]);
    network_.stiffness[b] *= factor;
    if (micropolar()) network_.bending[b] *= factor;
  }
}

/// Returns the bonds with an end that lacks neighbours or has neighbours of another material. In
/// micropolar bodies, and in space with few neighbours, particles bonded to such ends count as
/// well. A thinner layer has nearly singular equations, or no positive weights for forces and
/// moments along a side.
std::vector<std::uint8_t> Correction::free_bonds(const LatticeNeighbourhoods& neighbourhoods,
                                                 std::span<const Index> of_kinds) const {
  std::vector<Index> regular(static_cast<std::size_t>(network_.particles.size()), 0);
  const Bonds& bonds = network_.bonds;
  std::vector<LameConstants> constants;  // materials may differ only in strength
  for (const SolidMaterial& m : input_.materials) constants.push_back(lame_constants(input_, m));
  for (Index b = 0; b < bonds.size(); ++b) {
    const Index i = bonds.first[b], j = bonds.second[b];
    if (!(constants[material(i)] == constants[material(j)])) continue;
    if (of_kinds[bonds.kind_of(b)] == no_index) continue;
    ++regular[i];
    ++regular[j];
  }
  std::vector<std::uint8_t> layer(regular.size());
  for (std::size_t i = 0; i < layer.size(); ++i) layer[i] = regular[i] != neighbourhoods.size();
  if (micropolar() || (network_.dim() == 3 && neighbourhoods.size() < enough_in_space)) {
    const std::vector<std::uint8_t> thinner = layer;
    for (Index b = 0; b < bonds.size(); ++b) {
      if (thinner[bonds.first[b]]) layer[bonds.second[b]] = 1;
      if (thinner[bonds.second[b]]) layer[bonds.first[b]] = 1;
    }
  }
  std::vector<std::uint8_t> free(static_cast<std::size_t>(bonds.size()));
  for (Index b = 0; b < bonds.size(); ++b) {
    free[b] = layer[bonds.first[b]] != 0 || layer[bonds.second[b]] != 0;
  }
  return free;
}

void Correction::energy() {
  std::vector<double> wanted = wanted_moduli(nullptr);
  if (on_lattice()) {
    // Moduli of the lattice's interior neighbourhood, so that interior bonds do not change.
    double sum = 0.0;
    for (const Vector3& x : interior_neighbourhood(body_.lattice, input_.horizon).offsets) {
      sum += std::hypot(x[0], x[1], x[2]);
    }
    std::vector<double> micromoduli;
    for (const SolidMaterial& m : input_.materials) {
      micromoduli.push_back(moduli_of(body_, input_, m).micromodulus);
    }
    for (Index i = 0; i < network_.particles.size(); ++i) {
      wanted[i] = 0.5 * micromoduli[material(i)] * sum * body_.lattice.cell_volume *
                  network_.particles.volumes[i];
    }
  }
  scale_to(wanted, {});
}

void Correction::calibrate(bool give_up) {
  const Timer timer;
  std::optional<LatticeNeighbourhoods> neighbourhoods;
  std::vector<Index> of_kinds;
  fade_at_horizon();
  if (on_lattice()) {
    neighbourhoods.emplace(body_, input_);
    of_kinds = neighbourhoods_of_kinds(*neighbourhoods, network_.bonds);
    take_bulk_neighbourhoods(*neighbourhoods, of_kinds);
  } else if (!can_break(input_)) {
    favor_short_bonds();
  }
  const LatticeNeighbourhoods* neighbourhood = neighbourhoods ? &*neighbourhoods : nullptr;
  CalibrationInput calibration{network_.particles, network_.bonds, {}, {}};
  calibration.give_up = give_up;
  calibration.only_alike = input_.calibrating == Calibrating::only_alike;
  if (neighbourhood) {
    calibration.free = free_bonds(*neighbourhood, of_kinds);
    if (network_.hinged.empty()) {
      calibration.box = lattice_box(body_);
      const Pattern pattern = body_.lattice.pattern;
      const bool in_space = pattern == Pattern::cubic || pattern == Pattern::face_centred;
      if (in_space) calibration.step = body_.lattice.step;
    }
  }
  scale_to(wanted_moduli(neighbourhood), calibration.free);
  hinge();
  for (const SolidMaterial& m : input_.materials) {
    calibration.materials.push_back(lame_constants(input_, m));
  }
  // Later changes of single bonds do not affect their strength.
  if (!input_.elastic) network_.bending_ratio = own_bending_ratios(network_);
  if (input_.calibrating == Calibrating::estimated) {
    network_.report.calibration = expected_calibration(calibration, micropolar());
  } else if (!input_.is_draft()) {
    balance(calibration);
    network_.report.calibration->seconds = timer.seconds();
  }
  if (!input_.elastic) set_strength(neighbourhood);
}

/// Hinges bonds at particles on a joint, where rotations of the parts differ.
void Correction::hinge() {
  if (network_.hinged.empty()) return;
  network_.inflection.assign(network_.hinged.size(), 0.5);
  for (std::size_t b = 0; b < network_.hinged.size(); ++b) {
    const int ends = network_.hinged[b];
    if (ends == (first_end | second_end)) network_.bending[b] = 0.0;
    if (ends == first_end) network_.inflection[b] = 0.0;
    if (ends == second_end) network_.inflection[b] = 1.0;
  }
}

/// Sets critical stretches by the present stiffnesses.
void Correction::set_strength(const LatticeNeighbourhoods* neighbourhoods) {
  if (neighbourhoods == nullptr) {
    set_strength_of_unstructured(input_, network_);
  } else if (input_.critical_stretch == Constants::lattice) {
    set_critical_stretches(input_, *neighbourhoods, body_.lattice.cell_volume, network_);
  }
}

/// Calibrates the parts of a body that differ in stiffness, each as a separate body.
bool Correction::calibrate_parts() {
  if (input_.materials.size() < 2 || !input_.interfaces.empty()) return false;
  if (input_.is_draft() || input_.shell) return false;
  if (can_break(input_) && on_lattice() && input_.critical_stretch != Constants::lattice) {
    return false;
  }
  if (micropolar() && on_lattice() && network_.dim() == 3 &&
      interior_neighbourhood(body_.lattice, input_.horizon).offsets.size() < least_neighbours) {
    return false;
  }
  const Timer timer;
  const auto calibrate_part = [&](const Body& body, Network& part) {
    Correction(body, input_, part).calibrate(true);
    if (input_.elastic || !can_break(input_) || have_stretches(input_)) return;
    toughen_tied_faces(input_.horizon, body_.lattice.spacing, part);
  };
  if (!perilink::calibrate_parts(body_, input_, calibrate_part, network_)) return false;
  network_.report.calibration->seconds = timer.seconds();
  return true;
}

/// Calibrates the bonds, and removes bonds without stiffness.
void Correction::balance(const CalibrationInput& calibration) {
  BondStiffness stiffness{std::move(network_.stiffness), std::move(network_.bending),
                          std::move(network_.inflection)};
  CalibrationOptions options;
  options.on_search = input_.calibration.on_search;
  network_.report.calibration =
      calibrate_once(input_.calibration.store, calibration, options, network_.facets, stiffness);
  network_.stiffness = std::move(stiffness.axial);
  network_.bending = std::move(stiffness.bending);
  network_.inflection = std::move(stiffness.inflection);
  if (network_.report.calibration->dropped > 0) {
    std::vector<std::uint8_t> keep;
    for (const double k : network_.stiffness) keep.push_back(k > 0.0);
    keep_elements(network_, keep);
  }
}

}  // namespace

void correct_surfaces(const Body& body, const NetworkInput& input, Network& network) {
  const Surface surface = body.lattice.surface;
  if (surface == Surface::energy) Correction(body, input, network).energy();
  if (surface != Surface::calibrated) return;
  Correction correction(body, input, network);
  if (!correction.calibrate_parts()) correction.calibrate();
}

}  // namespace perilink
