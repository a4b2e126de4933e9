#include "app/model/body/strength_notes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "app/model/body/horizon_limits.hpp"

namespace perilink {
namespace {

/// Strengths of solids over their moduli: concrete, rock and ice have about 1e-4, glass 1e-3, steel
/// 2e-3, and 1e-2 is that of the strongest fibres. Brittle bonds stand for the former.
constexpr double largest_strength = 1e-2, largest_brittle_strength = 2e-3, least_strength = 1e-6;

/// Longest sides of the body in a process zone, E G_F / f_t^2, beyond which no crack has room. What
/// one tests of concrete in a laboratory has up to five.
constexpr double longest_zone = 10.0;

/// Brittle bonds have a process zone of about half a horizon. Where that is more of the body than
/// this, a crack has no room beside it.
constexpr double longest_brittle_zone = 0.25;

std::optional<std::string> note_of_strength(const MaterialStrength& strength, double modulus) {
  const bool brittle = strength.teeth == 1;
  const double part = strength.tensile_strength / modulus;
  const double most = brittle ? largest_brittle_strength : largest_strength;
  if (part <= most && part >= least_strength) return std::nullopt;
  const bool high = part > most;
  return fmt::format(
      "the tensile strength {:.4g} is {:.2g} of Young's modulus, {} {:g}: {}are the numbers of the "
      "material in units of one system?",
      strength.tensile_strength, part, high ? "above" : "below", high ? most : least_strength,
      !brittle ? ""
      : high   ? "brittle bonds have it by fracture_energy and horizon, the more the shorter that "
                 "is; with a tensile_strength bonds soften at that of the material; "
               : "brittle bonds have it by fracture_energy and horizon; ");
}

/// A brittle bond's zone and strength follow from the horizon alone.
std::optional<std::string> note_of_brittle_zone(double zone, double horizon, double body) {
  if (zone <= longest_brittle_zone * body) return std::nullopt;
  return fmt::format(
      "the process zone of brittle bonds, {:.4g}, is more than a quarter of the body's longest "
      "side "
      "{:.4g}: the strength, which is that of the horizon, decides when it breaks, and not "
      "fracture_energy; take a horizon below {:.3g}",
      zone, body, horizon * longest_brittle_zone * body / zone);
}

std::optional<std::string> note_of_zone(double zone, double horizon, double body) {
  if (zone < horizon) {
    return fmt::format(
        "the process zone {:.4g} is shorter than the horizon {:.4g}: bonds hardly soften, and the "
        "crack's tip is coarser than that of the material; a horizon of a tenth of it resolves it",
        zone, horizon);
  }
  if (zone <= longest_zone * body) return std::nullopt;
  return fmt::format(
      "the process zone {:.4g} is more than {:.0f} times the body's longest side {:.4g}: the body "
      "breaks by its tensile_strength, and fracture_energy hardly matters before it is in two; are "
      "the numbers in units of one system?",
      zone, longest_zone, body);
}

}  // namespace

std::vector<std::string> strength_notes(const MaterialStrength& strength, double youngs_modulus,
                                        double horizon, double body) {
  std::vector<std::string> notes;
  if (strength.teeth == 0) return notes;
  const double zone = strength.process_zone;
  for (const auto& note : {note_of_strength(strength, youngs_modulus),
                           strength.teeth == 1 ? note_of_brittle_zone(zone, horizon, body)
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
  for (std::size_t m = 0; m < model.network.strengths.size(); ++m) {
    const MaterialSection& material = input.materials[m];
    for (const std::string& note :
         strength_notes(model.network.strengths[m], material.youngs_modulus, model.horizon, body)) {
      notes.push_back(fmt::format("material \"{}\": {}", material.name, note));
    }
  }
  return notes;
}

}  // namespace perilink
