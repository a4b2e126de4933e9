#include "app/run/quasistatic.hpp"

#include <algorithm>
#include <cmath>

#include "app/run/run_warnings.hpp"
#include "assembly/internal_force.hpp"
#include "base/plain_text.hpp"
#include "model/reactions.hpp"

namespace perilink {
namespace {

/// Relative round-off of the force on a region.
constexpr double undecided = 1e-9;

}  // namespace

ElasticAnswer solve_elastic(const Model& model, const ElasticOptions& options) {
  ElasticAnswer answer;
  answer.solution = model.elements ? run_elastic_analysis(*model.elements, model.unknowns,
                                                          model.loads, options.threads)
                                   : run_elastic_analysis(model, options);
  answer.reason = "elastic equilibrium at load factor 1";
  const double energy = answer.solution.strain_energy;
  StepRecord& row = answer.row;
  row.step = 1;
  row.load_factor = 1.0;
  row.strain_energy = energy;
  row.external_work = answer.solution.work;
  row.load = model.reference.driven ? 2.0 * energy / model.reference.value : model.reference.value;
  row.displacement = row.load != 0.0 ? 2.0 * energy / row.load : 0.0;
  row.residual = answer.solution.residual;
  row.factorizations = answer.solution.subdomains == 0 ? 1 : 0;
  if (model.embedded) {
    row.elements = static_cast<Index>(std::ranges::count(model.embedded->whole, 1));
  }
  answer.peaks.add({row.displacement, row.load});
  return answer;
}

std::vector<RegionForce> region_forces(const Model& model, double load_factor, Secants secants,
                                       std::span<const double> motion, std::vector<double> forces,
                                       std::span<const std::uint8_t> whole) {
  const std::size_t dim = model.network.dim(), width = model.network.width();
  std::vector<RegionForce> places;
  for (const LoadRegion& place : model.load_regions) {
    RegionForce& at = places.emplace_back(RegionForce{place.name, {}});
    for (std::size_t a = 0; a < dim; ++a) at.force.push_back(load_factor * place.force[a]);
  }
  if (model.prescribed_regions.empty()) return places;
  if (forces.empty()) {
    forces = model.elements ? internal_force(*model.elements, motion).forces
                            : internal_force(model.network, secants, motion).forces;
  }
  load_particles(model.network, forces);
  pass_to_held(model, whole, model.loads.forces, forces);
  for (const PrescribedRegion& place : model.prescribed_regions) {
    RegionForce& at = places.emplace_back(RegionForce{place.name, std::vector<double>(dim, 0.0)});
    double sum = 0.0;
    for (const std::size_t slot : place.slots) {
      if (slot % width >= dim) continue;  // a moment
      const double reaction = forces[slot] - model.loads.forces[slot];
      at.force[slot % width] += load_factor * reaction;
      sum += std::abs(load_factor * reaction);
    }
    for (double& force : at.force) {
      if (std::abs(force) <= undecided * sum) force = 0.0;
    }
  }
  return places;
}

namespace {

std::string text_of_ranks(const FactorStatistics& factor) {
  return factor.ranks > 1 ? fmt::format(" by {} ranks", factor.ranks) : "";
}

std::string solver_text(const FactorStatistics& factor) {
  std::string work = factor.subdomains > 0
                         ? fmt::format("conjugate gradients, {}, preconditioner made {}",
                                       counted(factor.subdomains, "subdomain"),
                                       counted(factor.factorizations, "time"))
                         : counted(factor.factorizations, "factorisation");
  if (factor.iterations > 0) work += ", " + counted(factor.iterations, "iteration");
  return work + text_of_ranks(factor);
}

}  // namespace

Equilibria::Equilibria(const DamageResult& result)
    : last(result.last),
      peaks(result.peaks),
      other_peak(result.other_peak),
      has_events(true),
      factor(result.factor),
      solver(solver_text(result.factor)),
      initial_stiffness(result.initial_stiffness),
      largest_residual(result.largest_residual),
      broken_bonds(result.broken_bonds),
      energy_error(result.energy_error),
      smoothed_peak_load(result.smoothed_peak_load) {}

namespace {

std::string solver_text(const ElasticResult& solution) {
  if (solution.displacement.empty()) return "no equilibrium found";
  if (solution.subdomains == 0) return "1 factorisation";
  return fmt::format(
      "{} of conjugate gradients with {}{}, error "
      "{:.1e}",
      counted(solution.iterations, "iteration"), counted(solution.subdomains, "subdomain"),
      text_of_ranks(solution.factor), solution.error);
}

}  // namespace

Equilibria::Equilibria(const ElasticAnswer& answer)
    : last(answer.row),
      peaks(answer.peaks),
      factor(answer.solution.factor),
      solver(solver_text(answer.solution)),
      unsolved(answer.solution.error),
      initial_stiffness(last.displacement != 0.0 ? last.load / last.displacement : 0.0),
      largest_residual(answer.solution.residual),
      energy_error(last.external_work != 0.0 ? std::abs(last.external_work - last.strain_energy) /
                                                   std::abs(last.external_work)
                                             : 0.0) {}

void tell_equilibria(Summary& summary, const CaseFile& input, const Equilibria& found) {
  const StepRecord& last = found.last;
  tell_peaks(summary, input, found.peaks);
  if (found.other_peak) {
    summary.add("peak_load_other_sign", found.other_peak->load);
    summary.add("peak_displacement_other_sign", found.other_peak->displacement);
    summary.line("", "{:.6g} at {:.6g} is the largest load of the other sign",
                 found.other_peak->load, found.other_peak->displacement);
  }
  if (found.smoothed_peak_load) {
    summary.add("smoothed_peak_load", *found.smoothed_peak_load);
    summary.line("", "{:.6g} is the smoothed peak load", *found.smoothed_peak_load);
  }
  for (const RegionForce& place : found.places) {
    summary.json["places"].push_back({{"name", place.name}, {"force", place.force}});
    summary.line("", "({}) by {}", joined(place.force), place.name);
  }
  summary.add("initial_stiffness", found.initial_stiffness);
  summary.add("steps", last.step);
  summary.add("broken_bonds", found.broken_bonds);
  summary.add("yield_events", last.yield_events);
  if (found.has_events) {
    summary.line("events", "{}, {}, {}", counted(found.broken_bonds, "broken bond"),
                 counted(last.yield_events, "yield or softening event"), counted(last.step, "row"));
  }
  summary.add("external_work", last.external_work);
  summary.add("strain_energy", last.strain_energy);
  summary.add("dissipated_energy", last.dissipated_energy);
  summary.add("energy_error", found.energy_error);
  if (last.step > 0) {
    const double energy = found.has_events ? last.dissipated_energy : last.strain_energy;
    summary.line("energy", "{:.6g} {}, balance error {:.1e}", energy,
                 found.has_events ? "dissipated" : "stored", found.energy_error);
  }
  summary.add("largest_residual", found.largest_residual);
}

void tell_stages(Summary& summary, const CaseFile& input, const std::vector<StageResult>& stages) {
  for (std::size_t k = 0; k < stages.size(); ++k) {
    const StageResult& stage = stages[k];
    const std::string& name = input.stages[k].name;
    summary.json["stages"].push_back({{"name", name},
                                      {"loads", input.stages[k].loads},
                                      {"status", to_string(stage.termination)},
                                      {"reason", stage.reason},
                                      {"load_factor", stage.last.load_factor},
                                      {"load", stage.last.load},
                                      {"displacement", stage.last.displacement},
                                      {"peak_load", stage.peak.load},
                                      {"peak_displacement", stage.peak.displacement},
                                      {"largest_load", stage.largest.load},
                                      {"broken_bonds", stage.last.broken_bonds},
                                      {"steps", stage.last.step}});
    if (stage.smoothed_peak_load) {
      summary.json["stages"].back()["smoothed_peak_load"] = *stage.smoothed_peak_load;
    }
    const bool goes_on =
        k + 1 < stages.size() && input.stages[k + 1].loads == input.stages[k].loads;
    if (stage.largest.load != stage.peak.load && !goes_on && k + 1 < stages.size()) {
      summary.warnings.push_back(
          fmt::format("stage \"{}\": its load reached {:.6g}, fell, and rose again to "
                      "{:.6g}; the later peak is the residual strength after failure",
                      name, stage.peak.load, stage.largest.load));
    }
    summary.line(k == 0 ? "stages" : "", "{}: {}, load factor {:.6g}, load {:.6g}, {}", name,
                 stage.reason, stage.last.load_factor, stage.last.load,
                 counted(stage.last.broken_bonds, "broken bond"));
  }
}

void tell_quasistatic(Summary& summary, const CaseFile& input, const Model& model,
                      const Equilibria& found, double seconds) {
  const Index rows = found.last.step;
  tell_equilibria(summary, input, found);
  summary.add_warnings(
      warnings_of_balance(found.energy_error, found.largest_residual, found.unsolved));
  summary.add_warnings(found.warnings);
  summary.add("warnings", summary.warnings);
  tell_body(summary, model, ", " + counted(model.unknowns.count, "unknown"));
  if (model.embedded) {
    const auto carrying = std::ranges::count(model.embedded->whole, 1);
    summary.add("elements", carrying);
    summary.line("elements", "{} particles with {}", counted(carrying, "constrains", "constrain"),
                 counted(model.embedded->free.count, "unknown"));
  }
  summary.add("notes", summary.notes);
  summary.add("factorizations", found.factor.factorizations);
  if (found.factor.iterations > 0) summary.add("iterations", found.factor.iterations);
  summary.add("factor_bytes", std::max(found.factor.bytes, found.factor.most_bytes));
  if (found.factor.ranks > 1) summary.add("ranks", found.factor.ranks);
  summary.line("solver", "{}, largest residual {:.1e}", found.solver, found.largest_residual);
  if (found.has_events) summary.outcome = counted(found.broken_bonds, "broken bond") + ", ";
  summary.outcome +=
      fmt::format("{}, largest residual {:.2e}", found.solver, found.largest_residual);
  if (rows > 1) summary.rate = fmt::format("{:.3g} ms per row", 1e3 * seconds / rows);
}

}  // namespace perilink
