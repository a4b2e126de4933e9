#include "app/run/quasistatic_run.hpp"

#include <fmt/ranges.h>

#include "app/run/run_warnings.hpp"
#include "assembly/internal_force.hpp"

namespace perilink {

std::vector<PlaceForce> place_forces(const Model& model, double load_factor,
                                     std::span<const double> secants,
                                     std::span<const double> motion) {
  const std::size_t dim = model.network.dim(), width = model.network.width();
  std::vector<PlaceForce> places;
  for (const LoadedPlace& place : model.loaded_places) {
    PlaceForce& at = places.emplace_back(PlaceForce{place.name, {}});
    for (std::size_t a = 0; a < dim; ++a) at.force.push_back(load_factor * place.force[a]);
  }
  if (model.driven_places.empty()) return places;
  const InternalForce internal = model.elements ? internal_force(*model.elements, motion)
                                                : internal_force(model.network, secants, motion);
  for (const DrivenPlace& place : model.driven_places) {
    PlaceForce& at = places.emplace_back(PlaceForce{place.name, std::vector<double>(dim, 0.0)});
    for (const std::size_t slot : place.slots) {
      if (slot % width >= dim) continue;  // a moment
      const double reaction = internal.forces[slot] - model.loads.forces[slot];
      at.force[slot % width] += load_factor * reaction;
    }
  }
  return places;
}

void tell_equilibria(Summary& summary, const CaseFile& input, const Equilibria& found,
                     const std::vector<PlaceForce>& places) {
  const StepRecord& last = found.last;
  tell_peaks(summary, input, found.peaks);
  if (found.smoothed_peak_load) {
    summary.add("smoothed_peak_load", *found.smoothed_peak_load);
    summary.line("", "{:.6g} of the smooth curve through the events", *found.smoothed_peak_load);
  }
  for (const PlaceForce& place : places) {
    summary.json["places"].push_back({{"name", place.name}, {"force", place.force}});
    summary.line("", "({:.6g}) by {}", fmt::join(place.force, ", "), place.name);
  }
  summary.add("initial_stiffness", found.initial_stiffness);
  summary.add("steps", last.step);
  summary.add("broken_bonds", found.broken_bonds);
  summary.add("yield_events", last.yield_events);
  summary.line("events", "{} broken bonds, {} yield events, {} rows", found.broken_bonds,
               last.yield_events, last.step);
  summary.add("external_work", last.external_work);
  summary.add("strain_energy", last.strain_energy);
  summary.add("dissipated_energy", last.dissipated_energy);
  summary.add("energy_error", found.energy_error);
  summary.line("energy", "{:.6g} dissipated, balance to {:.1e}", last.dissipated_energy,
               found.energy_error);
  summary.add("largest_residual", found.largest_residual);
}

QuasistaticRun::QuasistaticRun(const CaseFile& input, int threads, bool quiet)
    : RunKind(input, threads), model_(build_model_visibly(input, quiet)) {
  take_notes(model_);
  plan = fmt::format("{}, {} unknowns", size_text(model_), model_.unknowns.count);
}

std::vector<std::string> QuasistaticRun::doubts() const {
  return doubts_of_balance(found().energy_error, found().largest_residual);
}

std::string QuasistaticRun::outcome() const {
  const Equilibria run = found();
  return fmt::format("{} broken bonds, {} factorisations, largest residual {:.2e}",
                     run.broken_bonds, run.factor.factorizations, run.largest_residual);
}

void QuasistaticRun::tell(Summary& summary) const {
  const Equilibria run = found();
  tell_equilibria(summary, input_, run, places());
  summary.add("doubts", doubts());
  tell_body(summary, model_, fmt::format(", {} unknowns", model_.unknowns.count));
  summary.add("notes", notes);
  summary.add("factorizations", run.factor.factorizations);
  summary.add("factor_bytes", run.factor.bytes);
  summary.line("solver", "{} factorisations, largest residual {:.1e}", run.factor.factorizations,
               run.largest_residual);
}

std::string QuasistaticRun::rate() const {
  const Index rows = found().last.step;
  return fmt::format("{:.3g} ms per row", rows > 1 ? 1e3 * seconds.analysis / rows : 0.0);
}

}  // namespace perilink
