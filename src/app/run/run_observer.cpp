#include "app/run/run_observer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/model/gauges.hpp"
#include "app/process/signals.hpp"
#include "app/results/field_file.hpp"
#include "assembly/fields.hpp"
#include "assembly/internal_force.hpp"
#include "base/timer.hpp"

namespace perilink {
namespace {

std::optional<Index> last_broken_bonds(const CaseFile& input) {
  if (!input.stop.broken_bonds) return std::nullopt;
  return static_cast<Index>(*input.stop.broken_bonds);
}

}  // namespace

RunObserver::RunObserver(const CaseFile& input, const Model& model, std::filesystem::path directory,
                         bool quiet)
    : input_(input),
      model_(model),
      directory_(std::move(directory)),
      history_(directory_.string(), names_of(model.gauges)),
      progress_(quiet, last_broken_bonds(input), input.stop.displacement),
      is_broken_(static_cast<std::size_t>(model.network.num_elements()), 0) {}

/// The element of the last row has failed by now; where several failed in one load step their order
/// within the step is that of their numbers.
void RunObserver::note_broken(const StepRecord& record, StateSource& source) {
  const std::size_t count = static_cast<std::size_t>(record.broken_bonds);
  if (count == broken_.size()) return;
  if (count == broken_.size() + 1 && last_element_ != no_index &&
      input_.analysis.control == LoadControl::events) {
    broken_.push_back(last_element_);
    is_broken_[last_element_] = 1;
    return;
  }
  const std::span<const double> secants = source.secants();
  for (Index e = 0; e < model_.network.num_elements(); ++e) {
    if (secants[e] != 0.0 || is_broken_[e]) continue;
    broken_.push_back(e);
    is_broken_[e] = 1;
  }
}

/// One place bears the whole load.
void RunObserver::note_places(const StepRecord& record, StateSource& source) {
  if (model_.loaded_places.size() + model_.driven_places.size() < 2) return;
  if (!(std::abs(record.load) > highest_)) return;
  highest_ = std::abs(record.load);
  places_.clear();
  const std::size_t dim = model_.network.dim(), width = model_.network.width();
  for (const LoadedPlace& place : model_.loaded_places) {
    PlaceForce& at = places_.emplace_back(PlaceForce{place.name, {}});
    for (std::size_t a = 0; a < dim; ++a) at.force.push_back(record.load_factor * place.force[a]);
  }
  if (model_.driven_places.empty()) return;
  const StepState state = source.state();
  const InternalForce internal =
      model_.elements ? internal_force(*model_.elements, state.displacement)
                      : internal_force(model_.network, state.secants, state.displacement);
  for (const DrivenPlace& place : model_.driven_places) {
    PlaceForce& at = places_.emplace_back(PlaceForce{place.name, std::vector<double>(dim, 0.0)});
    for (const std::size_t slot : place.slots) {
      if (slot % width >= dim) continue;  // a moment
      const double reaction = internal.forces[slot] - model_.loads.forces[slot];
      at.force[slot % width] += record.load_factor * reaction;
    }
  }
}

/// A load step may pass a number that the case asks for; the first row beyond it counts then.
bool RunObserver::wants_fields(Index broken_bonds) const {
  if (series_.empty()) return true;
  const Index last = broken_at_fields_;
  if (broken_bonds == last) return false;
  const std::vector<int>& at = input_.output.fields_at;
  if (std::any_of(at.begin(), at.end(), [&](int n) { return n > last && n <= broken_bonds; })) {
    return true;
  }
  const std::optional<int>& every = input_.output.fields_every;
  return every && broken_bonds / *every != last / *every;
}

VtuGrid RunObserver::make_grid(const StepRecord& record, StateSource& source) {
  const Network& network = model_.network;
  if (families_.rows() == 0) {
    families_ = bonds_of_particles(network.bonds, network.particles.size());
  }
  VtuGrid grid = model_.elements ? make_element_grid(*model_.elements, network.particles,
                                                     source.state().displacement, record,
                                                     model_.lattice.spacing)
                                 : make_field_grid(network, source.state(), record, broken_,
                                                   families_, model_.lattice.spacing);
  if (network.dim() == 2) grid.field_data.push_back({"thickness", input_.body.thickness});
  if (input_.analysis.type == AnalysisType::elastic) {
    const std::vector<double> displacement = translations(network, source.state().displacement);
    grid.point_data.push_back(
        {"stress", 6, particle_stresses(stress_input(model_, families_), displacement)});
  }
  return grid;
}

void RunObserver::write_fields(const StepRecord& record, StateSource& source) {
  const Timer timer;
  const std::string name = fmt::format("fields_{:06}.vtu", record.step);
  write_vtu((directory_ / name).string(), make_grid(record, source));
  broken_at_fields_ = record.broken_bonds;
  series_.push_back({static_cast<double>(record.step), name});
  write_pvd((directory_ / "fields.pvd").string(), series_);
  seconds_writing_ += timer.seconds();
}

void RunObserver::on_step(const StepRecord& record, StateSource& source) {
  note_broken(record, source);
  note_places(record, source);
  if (model_.gauges.empty()) {
    history_.append(record);
  } else {
    history_.append(record, gauge_values(model_, source.state(), record.load_factor));
  }
  progress_.update(record);
  if (wants_fields(record.broken_bonds)) write_fields(record, source);
  last_element_ = record.element;
}

void RunObserver::on_end(const StepRecord& last, StateSource& source) {
  const bool written = !series_.empty() && series_.back().time == static_cast<double>(last.step);
  if (last.step > 0 && !written) write_fields(last, source);
}

bool RunObserver::stop_requested() { return stop_signal_received(); }

void RunObserver::finish() {
  progress_.finish();
  history_.finish();
}

}  // namespace perilink
