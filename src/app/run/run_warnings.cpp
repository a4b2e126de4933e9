#include "app/run/run_warnings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/model/body/strength_notes.hpp"

namespace perilink {

namespace {

/// Part of the energy at the end that is motion [-].
double moving_part(const EnergyBalance& energy) {
  const double all = energy.kinetic + energy.stored + energy.internal_damping +
                     energy.external_damping + energy.fractured + energy.plastic;
  return all > 0.0 ? energy.kinetic / all : 0.0;
}

std::string text_of_pieces(Index pieces) {
  if (pieces == 0) return "the body, or pieces of it, move freely or are far from equilibrium";
  return pieces == 1 ? "a piece of the body is held by nothing"
                     : fmt::format("{} pieces of the body are held by nothing", pieces);
}

/// Runs that were cut short were not meant to end where they did.
void warning_motion(const ExplicitResult& result, const RunFacts& facts,
                    std::vector<std::string>& warnings) {
  constexpr double most_moving = 0.1;
  if (facts.impact || result.termination != Termination::completed) return;
  if (result.last.time < facts.wave_time) {
    warnings.push_back(fmt::format(
        "the run ends after {:.2g}, before a wave has gone along the body and back, which takes "
        "{:.2g}: what happens at one end is not known at the other; are modulus, density and time "
        "in units of one system?",
        result.last.time, facts.wave_time));
  }
  const double moving = moving_part(result.last.energy);
  if (moving <= most_moving) return;
  warnings.push_back(fmt::format(
      "{:.0f} % of the work is kinetic energy at the end: {}; loads and displacements are no "
      "static ones: load more slowly, damp the motion, or hold what flies",
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
  facts.wave_time = std::isfinite(slowness) ? 2.0 * length * slowness : 0.0;
  return facts;
}

std::vector<std::string> warnings_about(const ExplicitResult& result, const RunFacts& facts) {
  constexpr double most_surplus = 0.01, most_difference = 0.05;
  std::vector<std::string> warnings;
  if (result.largest_surplus > most_surplus) {
    warnings.push_back(
        fmt::format("energy appeared from nothing or vanished, up to {:.2g} % of the work: forces "
                    "and losses of these rules belong to no energy, or the step is too large",
                    100.0 * result.largest_surplus));
  }
  const double load = std::abs(facts.peak_load), reaction = std::abs(result.peak_load);
  // Supports that hold nothing but symmetry feel next to nothing of the load.
  const bool carries = reaction > 0.5 * load && load > 0.0;
  const double difference = std::abs(load - reaction);
  if (carries && difference > most_difference * reaction) {
    warnings.push_back(
        fmt::format("the peaks of load and reaction differ by {:.2g} %: inertia, or damping of the "
                    "motion by mass, is in the load; load more slowly, damp less, or read the "
                    "reaction",
                    100.0 * difference / reaction));
  }
  warning_motion(result, facts, warnings);
  return warnings;
}

std::vector<std::string> warnings_at_rest(const EnergyBalance& energy) {
  constexpr double most_surplus = 0.01;
  const double kept = energy.stored + energy.fractured;
  if (kept <= (1.0 + most_surplus) * energy.external_work) return {};
  return {fmt::format(
      "{:.6g} is stored and dissipated, but the load steps saw a work of {:.6g} only: bonds broke "
      "at a larger load than at the ends of their step; take smaller steps of load_factors",
      kept, energy.external_work)};
}

std::optional<std::string> warning_about_size(const CurvePoint& peak, double length) {
  constexpr double small = 0.1;
  const double part = std::abs(peak.displacement) / length;
  if (part <= small) return std::nullopt;
  return fmt::format(
      "the peak, {:.6g} at displacement {:.6g}, lies where the body has moved by {:.2g} of its "
      "longest side: bonds are made for small displacements and cannot tell whether it bears this "
      "load; look at the curve before, and end the run there by [stop]",
      peak.load, peak.displacement, part);
}

std::optional<std::string> warning_about_end(double displacement, double length) {
  const double part = std::abs(displacement) / length;
  if (part <= 1.0) return std::nullopt;
  return fmt::format(
      "at the end the body has moved by {:.2g} of its longest side: it could not bear the load and "
      "hangs together by next to nothing; the last rows, their work and energies are no states of "
      "it: look at the rows before, drive displacements, or end the run by [stop]",
      part);
}

std::optional<std::string> warning_about_motion(double share) {
  constexpr double few = 0.01;  // around point loads strains have no limit
  if (share <= few) return std::nullopt;
  return fmt::format(
      "{:.2g} % of the body is stretched or turned by more than a tenth, where the theory, one of "
      "small displacements, is no good: take smaller loads; are loads and moduli in units of one "
      "system?",
      100.0 * share);
}

std::string warning_about_crushing(const CurvePoint& largest) {
  return fmt::format(
      "bonds are shorter than small strains allow, or were about to be: the largest load, {:.6g} "
      "at displacement {:.6g}, may be borne by what is crushed and is no strength of the body; "
      "look at the curve before, and end the run there by [stop]",
      largest.load, largest.displacement);
}

Compression largest_compression(const Network& network, std::span<const double> principal) {
  Compression worst;
  if (network.has_crushing()) return worst;
  for (std::size_t i = 0; 3 * i < principal.size(); ++i) {
    const Index material = network.particles.material[i];
    if (material == no_index || network.strengths.empty()) continue;
    const double strength = network.strengths[material].tensile_strength;
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
      "no crushing law: at the largest load the largest compressive principal stress is {:.4g}, "
      "{:.3g} times the tensile strength, and has passed the compressive strength of most brittle "
      "materials, about ten times: the body may crush before; compare it with the compressive "
      "strength, or give the material softening = \"concrete\"",
      at_largest_load.stress, at_largest_load.times);
}

namespace {

/// Energy that events in tension take from a bond until its secant is this, over half of its
/// stiffness times the square of its extension at the critical stretch [-].
double energy_until(const BondLaw& law, double secant) {
  double energy = 0.0;
  for (int k = 0; law.segment(k).secant > secant; ++k) {
    const Segment segment = law.segment(k);
    energy += segment.limit * segment.limit * (segment.secant - law.segment(k + 1).secant);
  }
  return energy;
}

}  // namespace

SoftenedEnergy softened_energy(const Network& network, Secants secants) {
  constexpr double of_crack = 0.1;  // bonds at the strength of a sound body have lost 3 to 5 %
  SoftenedEnergy energy;
  for (Index e = 0; e < network.first_slip_spring; ++e) {
    const double left = secants.least(e);
    const BondLaw& law = network.law(e);
    if (left == 1.0 || !network.can_break(e) || law.is_brittle() || law.crushes()) continue;
    if (std::ranges::binary_search(network.cut_elements, e)) continue;
    const double lost = energy_until(law, left);
    const bool cracked = lost >= of_crack * energy_until(law, 0.0);
    const double extension = network.critical_stretch[e] * network.bonds.length(e);
    (cracked ? energy.cracks : energy.diffuse) +=
        0.5 * network.stiffness[e] * extension * extension * lost;
  }
  return energy;
}

std::optional<std::string> warning_about_diffuse_softening(const SoftenedEnergy& energy) {
  constexpr double most = 0.1;
  if (!(energy.cracks > 0.0) || energy.diffuse <= most * energy.cracks) return std::nullopt;
  return fmt::format(
      "diffuse softening: bonds that softened outside the cracks dissipated {:.4g}, {:.0f} % of "
      "the energy of the cracks: the body takes more energy than fracture_energy times the area of "
      "its cracks, and loads may be too large; {}, or let bonds break only where cracks may run "
      "(fracture_energy = \"infinite\" elsewhere)",
      energy.diffuse, 100.0 * energy.diffuse / energy.cracks, horizon_advice);
}

std::vector<std::string> warnings_of_balance(double energy_error, double largest_residual,
                                             double unsolved) {
  // Results are printed with six digits; equilibria are exact but for round-off, which leaves ten.
  constexpr double most_imbalance = 1e-6;
  std::vector<std::string> warnings;
  // Written so that what is not a number is in doubt too.
  if (!(energy_error <= most_imbalance)) {
    warnings.push_back(
        fmt::format("work and energies are out of balance, up to {:.2g} of the work: the body is "
                    "so compliant that round-off has reached its results",
                    energy_error));
  }
  if (!(unsolved <= most_imbalance)) {
    warnings.push_back(
        fmt::format("up to {:.2g} of the load is out of balance, since the iterations ended at an "
                    "error of {:.1g}: a smaller `tolerance` in [analysis], or solver = "
                    "\"direct\", brings displacements nearer",
                    largest_residual, unsolved));
  } else if (!(largest_residual <= most_imbalance)) {
    warnings.push_back(
        fmt::format("up to {:.2g} of the load is out of balance: the stiffness matrix is so close "
                    "to singular that displacements are not solved for to six digits",
                    largest_residual));
  }
  return warnings;
}

}  // namespace perilink
