#include "model/body/strength_notes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>

#include "io/case/case_words.hpp"
#include "model/body/horizon_limits.hpp"
#include "network/bond_strength.hpp"

namespace perilink {
namespace {

/// Limits of tensile strength over modulus: concrete, rock and ice have about 1e-4, glass 1e-3,
/// steel 2e-3, the strongest fibres 1e-2. Brittle bonds represent the first group.
constexpr double largest_strength = 1e-2, largest_brittle_strength = 2e-3, least_strength = 1e-6;

/// Process zone E G_F / f_t^2 over the longest side of the body beyond which no crack fits.
/// Laboratory specimens of concrete reach five.
constexpr double longest_zone = 10.0;

/// Horizon over process zone below which stressed bodies soften everywhere. A horizon equal to a
/// thirtieth up to round-off is accepted.
constexpr double least_horizon = (1.0 - 1e-6) / 30.0;

/// Largest process zone of brittle bonds, about half a horizon, over the longest side of the body.
/// Beyond it no crack fits next to the zone.
constexpr double longest_brittle_zone = 0.25;

/// Limits of the modulus of bars over that of the solid: glass-fibre bars in concrete have 1.3,
/// steel in concrete 7, in wood 20, in soil 2000.
constexpr double least_bar_modulus = 0.3, largest_bar_modulus = 5e3;

/// Strains at which bars yield: mild steel 1e-3, tendons 1e-2.
constexpr double least_yield_strain = 2e-4, largest_yield_strain = 2e-2;

std::optional<std::string> note_of_strength(const MaterialStrength& strength, double modulus) {
  const bool brittle = strength.segments == 1;
  const double part = strength.tensile_strength / modulus;
  const double most = brittle ? largest_brittle_strength : largest_strength;
  if (part <= most && part >= least_strength) return std::nullopt;
  const bool high = part > most;
  return fmt::format(
      "the tensile strength {:.4g} is {:.2g} of Young's modulus, {} {:g}: {}are the numbers of the "
      "material in units of one system?",
      strength.tensile_strength, part, high ? "above" : "below", high ? most : least_strength,
      !brittle ? ""
      : high   ? "the strength of brittle bonds follows from fracture_energy and "
                 "horizon and grows as the horizon shrinks; with tensile_strength bonds "
                 "soften at the strength of the material; "
               : "the strength of brittle bonds follows from fracture_energy and "
                 "horizon; ");
}

/// Returns a note on the process zone of brittle bonds, which follows from the horizon.
std::optional<std::string> note_of_brittle_zone(double zone, double horizon, double body) {
  if (zone <= longest_brittle_zone * body) return std::nullopt;
  return fmt::format(
      "the process zone of brittle bonds, {:.4g}, is more than a quarter of "
      "the body's longest side {:.4g}: failure then depends on the bond "
      "strength, which follows from the horizon, and not on fracture_energy; "
      "take a horizon below {:.3g}",
      zone, body, horizon * longest_brittle_zone * body / zone);
}

std::optional<std::string> note_of_zone(double zone, double horizon, double body) {
  if (zone < horizon) {
    return fmt::format(
        "the process zone {:.4g} is shorter than the horizon {:.4g}: bonds "
        "hardly soften, and the horizon does not resolve the crack tip; {}",
        zone, horizon, horizon_advice);
  }
  if (zone <= longest_zone * body) {
    if (horizon >= least_horizon * zone) return std::nullopt;
    return fmt::format(
        "the horizon {:.4g} is below a thirtieth of E G_F / f_t^2, {:.4g}: "
        "stressed parts of the body soften before a crack forms; the body "
        "dissipates more than fracture_energy times the crack area, and the "
        "peak load of bodies without a notch is too high; {}",
        horizon, zone, horizon_advice);
  }
  return fmt::format(
      "the process zone {:.4g} is more than {:.0f} times the body's longest "
      "side {:.4g}: the peak load depends on tensile_strength, and hardly on "
      "fracture_energy; are the numbers in units of one system?",
      zone, longest_zone, body);
}

/// Returns a note on a bar with an unusual modulus or yield strain.
/// \param softest,stiffest  smallest and largest modulus of all solid materials
std::optional<std::string> note_of_bar(const RebarSection& bar, double softest, double stiffest) {
  const bool is_soft = bar.youngs_modulus < least_bar_modulus * softest;
  if (is_soft || bar.youngs_modulus > largest_bar_modulus * stiffest) {
    const double solid = is_soft ? softest : stiffest;
    return fmt::format("Young's modulus {:.4g} is {:.2g} times that of the solid, {:.4g}",
                       bar.youngs_modulus, bar.youngs_modulus / solid, solid);
  }
  if (!bar.yield_strength || !bar.yields) return std::nullopt;
  const double strain = *bar.yield_strength / bar.youngs_modulus;
  if (strain >= least_yield_strain && strain <= largest_yield_strain) return std::nullopt;
  return fmt::format("it yields at {:.4g}, which is {:.2g} of its Young's modulus {:.4g}",
                     *bar.yield_strength, strain, bar.youngs_modulus);
}

}  // namespace

bool is_short_horizon(double horizon, const MaterialStrength& strength) {
  return strength.segments > 1 && horizon < least_horizon * strength.process_zone;
}

std::optional<std::string> path_note(const CaseFile& input, const Model& model) {
  const Network& network = model.network;
  if (network.is_beam() || !input.interfaces.empty()) return std::nullopt;
  Index bond = 0;
  while (bond < network.first_slip_spring && !network.can_break(bond)) ++bond;
  if (bond == network.first_slip_spring) return std::nullopt;
  const bool turns = network.shell || input.body.model == BodyModel::micropolar;
  if (model.lattice.pattern != Pattern::irregular) {
    return fmt::format(
        "cracks tend to follow the rows of a lattice: where the path is not known, take pattern = "
        "\"unstructured\"{}",
        turns ? "" : " and model = \"micropolar\"");
  }
  if (turns || input.body.mesh) return std::nullopt;
  return "cracks of bond_based bodies stay too straight under shear: where the path is not known, "
         "take model = \"micropolar\"";
}

std::optional<std::string> unnotched_note(const CaseFile& input, const Model& model) {
  const Network& network = model.network;
  const bool softens =
      std::ranges::any_of(network.report.strengths,
                          [](const MaterialStrength& strength) { return strength.segments > 1; });
  const bool scatters = std::ranges::any_of(input.fields.random, [](const RandomSection& random) {
    return random.property == VaryingProperty::tensile_strength;
  });
  if (!softens || scatters || network.has_crushing() || network.has_sections() ||
      !input.cracks.empty() || !input.interfaces.empty() || !input.rebar.empty()) {
    return std::nullopt;
  }
  // Such a plane of symmetry holds a ligament; the rest of the face is a notch.
  const auto holds_part = [](const SymmetrySection& plane) { return !plane.region.empty(); };
  if (std::ranges::any_of(input.symmetry, holds_part)) return std::nullopt;
  const Particles& particles = network.particles;
  const Vector3 sides = reach_of(particles, model.horizon, model.lattice.spacing).extents;
  const double box = sides[0] * sides[1] * (particles.dim == 2 ? input.body.thickness : sides[2]);
  const double volume = std::accumulate(particles.volumes.begin(), particles.volumes.end(), 0.0);
  constexpr double round_off = 1e-6;
  if (volume < (1.0 - round_off) * box) return std::nullopt;
  return "the body has no notch, hole or pre-crack: in bending its strength exceeds that of one "
         "cohesive crack by 10 to 30 %, the more the shorter the horizon; with random strength "
         "([[random]], variation 0.1, correlation_length of one horizon) by about 9 %";
}

std::optional<std::string> joint_note(const NetworkInput& input, const Model& model) {
  const Network& network = model.network;
  if (input.elastic || input.is_draft() || !input.interfaces.empty()) return std::nullopt;
  if (!network.report.calibration || network.has_sections()) return std::nullopt;
  constexpr double negligible = 1.05;
  double largest = 1.0;
  const Facets& facets = network.facets;
  for (Index f = 0; f < facets.size(); ++f) {
    if (facets.on_surface(f) || facets.is_tied(f)) continue;
    const SolidMaterial& one = input.materials[facets.inside[f]];
    const SolidMaterial& other = input.materials[facets.outside[f]];
    if (!std::isfinite(energy_between(one, other))) continue;
    const auto [least, most] = std::minmax(one.youngs_modulus, other.youngs_modulus);
    largest = std::max(largest, most / least);
  }
  if (largest <= negligible || network.report.calibration->in_parts) return std::nullopt;
  return fmt::format(
      "materials of unlike stiffness (moduli 1 and {:.3g}) meet, and are calibrated as a whole: a "
      "crack along their joint dissipates less than the smaller fracture energy, 0.4 of it at "
      "moduli 1 and 4, and begins at a lower load; where a crack may run along it, give strength "
      "and energy of the joint by [[interfaces]]",
      largest);
}

std::vector<std::string> field_notes(const NetworkInput& input, const Network& network) {
  std::vector<std::string> notes;
  for (const PropertyField& field : input.fields) {
    const bool stiffens = field.property == VaryingProperty::youngs_modulus;
    const std::vector<double> factors = factors_on(field.property, input, {&field, 1}, network);
    double count = 0.0, sum = 0.0, squares = 0.0;
    double least = std::numeric_limits<double>::infinity(), most = 0.0;
    for (Index b = 0; b < network.num_bonds(); ++b) {
      const auto [i, j] = materials_of_bond(network, b);
      if (!(stiffens || network.has_limit(b)) || (field.varies[i] == 0 && field.varies[j] == 0)) {
        continue;
      }
      const double factor = factors[b];
      count += 1.0;
      sum += factor - 1.0;
      squares += (factor - 1.0) * (factor - 1.0);
      least = std::min(least, factor);
      most = std::max(most, factor);
    }
    if (count == 0.0) continue;
    if (field.factor) {
      notes.push_back(fmt::format("graded {}: over {} bonds the factor is {:.4g} to {:.4g}",
                                  word_of(field.property), count, least, most));
      continue;
    }
    const double mean = sum / count;
    notes.push_back(fmt::format(
        "random {} with seed {}: over {} bonds the factor has mean {:.4g}, standard deviation "
        "{:.4g}, least {:.4g}, largest {:.4g}{}",
        word_of(field.property), field.random.seed, count, 1.0 + mean,
        std::sqrt(std::max(0.0, squares / count - mean * mean)), least, most,
        field.random.correlation_length < input.horizon
            ? "; correlation_length is below the horizon, over which bonds average: take at "
              "least one horizon"
            : ""));
  }
  return notes;
}

std::vector<std::string> bar_notes(const CaseFile& input) {
  double softest = std::numeric_limits<double>::infinity(), stiffest = 0.0;
  for (const MaterialSection& material : input.materials) {
    softest = std::min(softest, material.youngs_modulus);
    stiffest = std::max(stiffest, material.youngs_modulus);
  }
  std::vector<std::string> notes;
  for (std::size_t k = 0; k < input.rebar.size(); ++k) {
    if (const auto note = note_of_bar(input.rebar[k], softest, stiffest)) {
      notes.push_back(
          fmt::format("bar {}: {}: are the numbers in units of one system?", k + 1, *note));
    }
  }
  return notes;
}

std::vector<std::string> strength_notes(const MaterialStrength& strength, double youngs_modulus,
                                        double horizon, double body) {
  std::vector<std::string> notes;
  if (strength.segments == 0) return notes;
  const double zone = strength.process_zone;
  for (const auto& note : {note_of_strength(strength, youngs_modulus),
                           strength.segments == 1 ? note_of_brittle_zone(zone, horizon, body)
                                                  : note_of_zone(zone, horizon, body)}) {
    if (note) notes.push_back(*note);
  }
  return notes;
}

std::vector<std::string> strength_notes(const CaseFile& input, const Model& model) {
  const HorizonReach reach =
      reach_of(model.network.particles, model.horizon, model.lattice.spacing);
  const double body = *std::max_element(reach.extents.begin(), reach.extents.end());
  std::vector<std::string> notes;
  for (std::size_t m = 0; m < model.network.report.strengths.size(); ++m) {
    const MaterialSection& material = input.materials[m];
    for (const std::string& note : strength_notes(model.network.report.strengths[m],
                                                  material.youngs_modulus, model.horizon, body)) {
      notes.push_back(fmt::format("material \"{}\": {}", material.name, note));
    }
  }
  return notes;
}

}  // namespace perilink
