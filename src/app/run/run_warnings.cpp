#include "app/run/run_warnings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "model/body/strength_notes.hpp"
#include "network/bond_softening.hpp"

namespace perilink {

namespace {

/// Returns the kinetic fraction of the energy at the end [-].
double moving_part(const EnergyBalance& energy) {
  const double all = energy.kinetic + energy.stored + energy.internal_damping +
                     energy.external_damping + energy.fractured + energy.plastic;
  return all > 0.0 ? energy.kinetic / all : 0.0;
}

std::string text_of_pieces(Index pieces) {
  if (pieces == 0) return "the body, or pieces of it, move freely or are far from equilibrium";
  return pieces == 1 ? "a piece of the body is unsupported"
                     : fmt::format("{} pieces of the body are unsupported", pieces);
}

/// Adds warnings on the motion at the end. Interrupted runs get none.
void warning_motion(const ExplicitResult& result, const RunFacts& facts,
                    std::vector<std::string>& warnings) {
  constexpr double most_moving = 0.1;
  if (facts.impact || result.termination != Termination::completed) return;
  if (result.last.time < facts.wave_time) {
    warnings.push_back(
        fmt::format("the run ends after {:.2g}, before an elastic wave has crossed the "
                    "body and returned ({:.2g}): the far end has not responded to the "
                    "load; are modulus, density and time in units of one system?",
                    result.last.time, facts.wave_time));
  }
  const double moving = moving_part(result.last.energy);
  if (moving <= most_moving) return;
  warnings.push_back(
      fmt::format("{:.0f} % of the work is kinetic energy at the end: {}; loads and "
                  "displacements are not static: load more slowly, damp the motion, or "
                  "support the free pieces",
                  100.0 * moving, text_of_pieces(facts.loose_pieces)));
}

}  // namespace

RunFacts run_facts(const CaseFile& input, double length, double peak_load) {
  double slowness = INFINITY;
  for (const MaterialSection& material : input.materials) {
    const double density = material.density.value_or(INFINITY);
    slowness = std::min(slowness, std::sqrt(density / material.youngs_modulus));
  }
  RunFacts facts;
  facts.peak_load = peak_load;
  facts.impact = !input.velocities.empty();
  facts.ramp_ends = facts.impact || input.analysis.ramp_time <= input.analysis.duration;
  facts.wave_time = std::isfinite(slowness) ? 2.0 * length * slowness : 0.0;
  return facts;
}

std::vector<std::string> warnings_about(const ExplicitResult& result, const RunFacts& facts) {
  constexpr double most_surplus = 0.01, most_difference = 0.05, negligible = 0.1;
  std::vector<std::string> warnings;
  if (result.largest_surplus > most_surplus) {
    warnings.push_back(
        fmt::format("the energy balance has an error of up to {:.2g} % of the work: the "
                    "constitutive rules are not conservative, or the time step is too "
                    "large; reduce the time step",
                    100.0 * result.largest_surplus));
  }
  const double load = std::abs(facts.peak_load), reaction = std::abs(result.peak_load);
  // Supports that only enforce symmetry carry a negligible part of the load.
  const bool carries = reaction > negligible * load && load > 0.0;
  const double difference = std::abs(load - reaction);
  if (carries && difference > most_difference * reaction) {
    warnings.push_back(
        fmt::format("the peaks of load and reaction differ by {:.{}g} %: the load includes "
                    "inertia or mass-proportional damping; load more slowly, damp less, or "
                    "use the reaction",
                    100.0 * difference / reaction, difference < reaction ? 2 : 3));
  }
  if (!facts.ramp_ends && result.termination == Termination::completed) {
    warnings.push_back(
        fmt::format("the run ends at load factor {:.3g}: ramp_time is longer than duration",
                    result.last.load_factor));
  }
  warning_motion(result, facts, warnings);
  return warnings;
}

std::vector<std::string> warnings_at_rest(const ExplicitRecord& last) {
  const EnergyBalance& energy = last.energy;
  constexpr double most_surplus = 0.01;
  const double kept = energy.stored + energy.fractured;
  if (kept <= (1.0 + most_surplus) * energy.external_work) return {};
  return {fmt::format(
      "the stored and dissipated energy {:.6g} exceeds the work of the load "
      "steps {:.6g}: {}; use smaller steps in load_factors",
      kept, energy.external_work,
      last.broken_bonds > 0 ? "bonds broke at larger loads than at the ends of their steps"
                            : "it is counted with the mean of the loads at the ends of a step")};
}

std::optional<std::string> warning_about_size(const CurvePoint& peak, double length) {
  constexpr double small = 0.1;
  const double part = std::abs(peak.displacement) / length;
  if (part <= small) return std::nullopt;
  return fmt::format(
      "the peak, {:.6g} at displacement {:.6g}, lies where the displacement "
      "is {:.2g} of the body's longest side: the theory assumes small "
      "displacements, so this peak is not the strength of the body; use the "
      "curve before it, and end the run there by [stop]",
      peak.load, peak.displacement, part);
}

std::optional<std::string> warning_about_end(double displacement, double length) {
  const double part = std::abs(displacement) / length;
  if (part <= 1.0) return std::nullopt;
  return fmt::format(
      "at the end the displacement is {:.2g} of the body's longest side: the "
      "remaining ligament carries no load; disregard the last rows with "
      "their work and energies; prescribe displacements, or end the run by "
      "[stop]",
      part);
}

std::optional<std::string> warning_about_motion(double share) {
  constexpr double few = 0.01;  // strains around point loads are singular
  if (share <= few) return std::nullopt;
  return fmt::format(
      "{:.3g} % of the body is stretched or rotated by more than a tenth, "
      "beyond the range of the theory of small displacements; use smaller "
      "loads; are loads and moduli in units of one system?",
      100.0 * share);
}

std::optional<std::string> warning_about_steps(const StepRecord& last, double area) {
  constexpr double most = 0.02;  // of the area
  const double surplus = last.external_work - area;
  if (!(area > 0.0 && surplus > most * area) || last.dissipated_energy == 0.0) return std::nullopt;
  return fmt::format(
      "the work and the dissipated energy are {:.3g} too large, {:.2g} % of the area {:.6g} under "
      "the curve: bonds fail at the end of a step; take smaller steps or control = \"events\"",
      surplus, 100.0 * surplus / area, area);
}

std::string warning_about_crushing(const CurvePoint& largest) {
  return fmt::format(
      "bonds are compressed beyond small strains: the largest load, {:.6g} "
      "at displacement {:.6g}, may be carried by crushed material and is not "
      "the strength of the body; use the curve before it, and end the run "
      "there by [stop]",
      largest.load, largest.displacement);
}

Compression largest_compression(const Network& network, std::span<const double> principal,
                                std::span<const double> damage) {
  constexpr double most_damage = 0.5;
  Compression worst;
  if (network.has_crushing()) return worst;
  for (std::size_t i = 0; 3 * i < principal.size(); ++i) {
    const Index material = network.particles.material[i];
    if (material == no_index || network.report.strengths.empty() || damage[i] > most_damage)
      continue;
    const double strength = network.report.strengths[material].tensile_strength;
    if (!(strength > 0.0)) continue;
    const double stress = -*std::min_element(&principal[3 * i], &principal[3 * i] + 3);
    if (stress > worst.times * strength) worst = {stress, stress / strength};
  }
  return worst;
}

std::optional<std::string> warning_about_compression(const Compression& at_largest_load) {
  constexpr double most = 10.0;  // compressive over tensile strength of concrete and rock
  if (at_largest_load.times <= most) return std::nullopt;
  return fmt::format(
      "no crushing law: at the largest load the largest compressive "
      "principal stress is {:.4g}, {:.3g} times the tensile strength; most "
      "brittle materials crush at about ten times: the body may crush before "
      "this load; compare the stress with the compressive strength, or give "
      "the material softening = \"concrete\"",
      at_largest_load.stress, at_largest_load.times);
}

SoftenedEnergy softened_energy(const Network& network, Secants secants) {
  constexpr double of_crack = 0.1;  // bonds of an intact body at its strength have lost 3 to 5 %
  SoftenedEnergy energy;
  for (Index e = 0; e < network.first_contact(); ++e) {
    const double left = secants.least(e);
    const BondLaw& law = network.law(e);
    if (left == 1.0 || !network.can_break(e) || law.is_brittle() || law.crushes()) continue;
    const double lost = dissipated_until(network, e, left), all = dissipated_until(network, e, 0.0);
    const bool cracked = lost >= of_crack * all;
    (cracked ? energy.cracks : energy.diffuse) += lost;
    if (cracked) energy.fracture += all;
  }
  return energy;
}

std::optional<std::string> warning_about_diffuse_softening(const SoftenedEnergy& energy,
                                                           bool short_horizon) {
  constexpr double most = 0.1, of_open_crack = 0.5;
  if (!(energy.cracks > of_open_crack * energy.fracture)) return std::nullopt;
  if (energy.diffuse <= most * energy.cracks) return std::nullopt;
  return fmt::format(
      "diffuse softening: bonds that softened outside the cracks dissipated "
      "{:.4g}, {:.0f} % of the energy of the cracks: the body dissipates "
      "more energy than fracture_energy times the area of its cracks, and "
      "loads may be too large; {}make bonds breakable only where cracks "
      "may run (fracture_energy = \"infinite\" elsewhere)",
      energy.diffuse, 100.0 * energy.diffuse / energy.cracks,
      short_horizon ? std::string(horizon_advice) + ", or " : "");
}

std::vector<std::string> warnings_of_balance(double energy_error, double largest_residual,
                                             double unsolved) {
  // Results are printed with six digits; round-off leaves ten digits of an equilibrium.
  constexpr double most_imbalance = 1e-6;
  std::vector<std::string> warnings;
  // Written so that not-a-number warns too.
  if (!(energy_error <= most_imbalance)) {
    warnings.push_back(
        fmt::format("work and energies are out of balance, up to {:.2g} of the work: the "
                    "body is so compliant that round-off affects its results",
                    energy_error));
  }
  if (!(unsolved <= most_imbalance)) {
    warnings.push_back(
        fmt::format("up to {:.2g} of the load is out of balance, because the iterations "
                    "ended at an error of {:.1g}; for more accurate displacements give a "
                    "smaller `tolerance` in [analysis], or solver = \"direct\"",
                    largest_residual, unsolved));
  } else if (!(largest_residual <= most_imbalance)) {
    warnings.push_back(
        fmt::format("up to {:.2g} of the load is out of balance: the stiffness matrix is "
                    "nearly singular, and displacements have fewer than six correct digits",
                    largest_residual));
  }
  return warnings;
}

}  // namespace perilink
