#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "app/run/damage_run.hpp"
#include "discretization/bonds.hpp"
#include "model/gauges.hpp"
#include "results/bar_file.hpp"
#include "results/body_cells.hpp"
#include "results/crack_file.hpp"

/// \file
/// Field files of a damage run: those of the last row, and of the peak.

namespace perilink {

/// Returns the largest compression at a row: that of its fields where it has some. Else it is that
/// of the first field file in proportion to the load, with stages the largest of all.
Compression DamageRun::compression_at(const CurvePoint& row) const {
  const std::vector<FieldCompression>& known = records_.compressions;
  const auto own = std::ranges::find_if(known, [&](const FieldCompression& file) {
    return file.row.load == row.load && file.row.displacement == row.displacement;
  });
  if (own != known.end()) return own->largest;
  Compression largest;
  for (const FieldCompression& file : known) {
    if (file.largest.times > largest.times) largest = file.largest;
  }
  if (!input.stages.empty() || known.empty() || known.front().row.load == 0.0) return largest;
  const double scale = std::abs(row.load / known.front().row.load);
  return {scale * known.front().largest.stress, scale * known.front().largest.times};
}

/// Whether fields are due: at the first row of the run and of each stage, and at requested rows,
/// values, and numbers of broken bonds. A load step may skip such a number; the next row counts
/// then.
bool DamageRun::wants_fields(const StepRecord& record) const {
  if (!files_->has_fields() || record.stage != records_.last_stage) return true;
  if (files_->reaches_value()) return true;
  const std::optional<int>& rows = input.output.fields_every_rows;
  if (rows && record.step % *rows == 0) return true;
  const Index last = records_.broken_at_fields, broken_bonds = record.broken_bonds;
  if (broken_bonds == last) return false;
  const std::vector<int>& at = input.output.fields_at;
  if (std::any_of(at.begin(), at.end(), [&](int n) { return n > last && n <= broken_bonds; })) {
    return true;
  }
  const std::optional<int>& every = input.output.fields_every;
  return every && broken_bonds / *every != last / *every;
}

ModelState DamageRun::model_state(const StepRecord& record, const StepState& state) const {
  ModelState now{state.secants, state.displacement, scale_of(record), record.load_factor,
                 records_.set_factors};
  now.whole = state.whole;
  return now;
}

/// Returns the fields of a row and writes its tables.
/// \param is_last  the row is the last one so far: its cracks count for the summary
VtuGrid DamageRun::fields_of(const StepRecord& record, const StepState& state, bool is_last) {
  const Network& network = model_.network;
  if (neighbourhoods_.rows() == 0) {
    neighbourhoods_ = bonds_of_particles(network.bonds, network.particles.size());
  }
  const auto broken =
      std::span(records_.broken).first(static_cast<std::size_t>(record.broken_bonds));
  std::vector<double> motion(state.displacement.begin(), state.displacement.end());
  for (double& u : motion) u *= scale_of(record);
  VtuGrid grid = make_field_grid(network, state.secants, motion, moment_of(record, input, model_),
                                 broken, neighbourhoods_);
  records_.overlap = deepest_overlap(model_, motion, records_.overlap);
  if (network.is_beam()) {
    add_section_forces(grid, section_forces(network, state.secants, motion));
  }
  if (!network.has_sections()) {
    add_stresses(grid,
                 particle_stresses(stress_input(model_, neighbourhoods_, state.secants), motion),
                 network.dim());
    const CrackOpenings openings = crack_openings(network, neighbourhoods_, state.secants, motion);
    add_openings(grid, network, openings, broken);
    const std::vector<GrownCrack> cracks =
        list_cracks(network, neighbourhoods_, openings, model_.lattice.spacing);
    if (!cracks.empty()) {
      files_->write_table("cracks", record.step, crack_table(cracks, network.dim()));
    }
    records_.compressions.push_back(
        {{record.displacement, record.load},
         largest_compression(network, grid.find_point_data("principal_stress")->values,
                             grid.find_point_data("damage")->values)});
    if (is_last) records_.cracks = cracks;
  }
  write_reactions(record, places_held_, model_state(record, state), records_.balance);
  if (!network.bars.bar.empty()) {
    const BarState bars = bar_state(network, state.secants, motion);
    add_bars(grid, bars);
    files_->write_table("bars", record.step, bar_table(network, bars));
  }
  if (model_.embedded) add_hosts(grid, network.particles, model_.embedded->hosts, state.whole);
  if (input.output.body_cells) {
    add_body_cells(
        grid,
        body_cells(model_.network, model_.lattice, model_.cells, neighbourhoods_, state.secants),
        network.dim());
  }
  return grid;
}

void DamageRun::write_state(const StepRecord& record, StateSource& source) {
  files_->write_fields(record.step, record.step,
                       [&] { return fields_of(record, source.state(), true); });
  records_.broken_at_fields = record.broken_bonds;
}

/// Keeps the state of a row that may be the peak. Once the load has fallen below half of the
/// largest, writes its fields, so that a killed run leaves them.
void DamageRun::note_peak(const StepRecord& record, StateSource& source) {
  PeakStates& peaks = records_.peaks;
  const auto load_case = [&](Index stage) { return set_of_stage_[stage - 1]; };
  if (records_.last_stage > 0 && load_case(record.stage) != load_case(records_.last_stage)) {
    peaks.clear();
  }
  peaks.add(record, source, input.analysis.control == LoadControl::events);
  const PeakStates::State* highest = peaks.highest();
  if (records_.written_peak != 0 || highest == nullptr ||
      std::abs(record.load) >= collapsed_part * std::abs(highest->row.load)) {
    return;
  }
  if (write_fields_of(*highest, source)) records_.written_peak = highest->row.step;
}

/// \return whether the row had no fields before
bool DamageRun::write_fields_of(const PeakStates::State& peak, StateSource& source) {
  return files_->write_fields(peak.row.step, peak.row.step, [&] {
    const PeakStates::Ratios ratios = records_.peaks.ratios(peak, model_.network.num_elements());
    StepState state{model_.network, ratios, peak.displacement, peak.whole};
    const std::vector<double> motion = source.completed(state);
    state.displacement = motion;
    std::vector<double> factors = records_.set_factors;
    const Index stage = peak.row.stage;
    if (stage > 0) factors[set_of_stage_[stage - 1]] = peak.row.load_factor;
    std::swap(factors, records_.set_factors);  // the tables need those of that row
    VtuGrid grid = fields_of(peak.row, state, false);
    std::swap(factors, records_.set_factors);
    return grid;
  });
}

/// Writes the fields at the peak, which is known at the end. Those of a row that turned out to be
/// no peak are removed.
void DamageRun::write_peak(const DamageResult& result, StateSource& source) {
  if (!input.output.fields_at_peak) return;
  const PeakStates::State* peak = records_.peaks.find({result.peak_displacement, result.peak_load});
  const Index written = records_.written_peak;
  if (written != 0 && (peak == nullptr || peak->row.step != written)) {
    files_->remove_fields(written);
  }
  if (peak != nullptr && peak->row.step != result.last.step) write_fields_of(*peak, source);
}

}  // namespace perilink
