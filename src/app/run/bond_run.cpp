#include "app/run/bond_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numeric>
#include <utility>

#include "app/model/body/particle_model.hpp"
#include "app/model/gauges.hpp"
#include "app/process/signals.hpp"
#include "app/results/field_file.hpp"
#include "app/results/summary_file.hpp"
#include "app/run/run_warnings.hpp"
#include "base/build_info.hpp"
#include "base/error.hpp"

namespace perilink {
namespace {

constexpr double most_steps = 2e9;  ///< steps have 32-bit numbers
/// The time of a step may fall short of the time that is wanted by this part of itself.
constexpr double round_off = 1e-9;

std::vector<double> densities(const CaseFile& input) {
  std::vector<double> density;
  for (const MaterialSection& material : input.materials) density.push_back(*material.density);
  return density;
}

void choose_steps(const CaseFile& input, BondRunCase& built) {
  const AnalysisSection& analysis = input.analysis;
  const double critical = built.inertia.critical_time_step();
  const double step = analysis.time_step.value_or(analysis.safety * critical);
  if (step > critical) {
    throw InputError(
        input.where("analysis.time_step"),
        fmt::format("is {:.6g}, larger than the critical time step {:.6g}", step, critical),
        "take less, or leave it out: `safety` takes a part of the critical one");
  }
  const double steps = std::ceil(analysis.duration / step);
  if (!(steps <= most_steps)) {
    throw InputError(input.where("analysis.duration"),
                     fmt::format("takes {:.1e} steps of {:.4g}", steps, step),
                     fmt::format("at most {:.0e} are possible", most_steps));
  }
  built.steps = static_cast<Index>(steps);
  built.options.duration = analysis.duration;
  built.options.ramp = analysis.ramp_time;
  built.options.time_step = step;
  built.options.rows = analysis.rows;
}

/// Parts of the body, of a hundredth of its particles or more, that have no elastic supports and in
/// which no displacement is prescribed.
Index loose_pieces(const Model& model, const BondRunState& state) {
  const Bonds& bonds = model.network.bonds;
  const Index count = model.network.particles.size();
  std::vector<Index> piece(static_cast<std::size_t>(count));
  std::iota(piece.begin(), piece.end(), 0);
  const auto root = [&](Index i) {
    while (piece[i] != i) i = piece[i] = piece[piece[i]];
    return i;
  };
  const std::vector<double> secants = state.bonds.secants();
  for (Index e = 0; e < bonds.size(); ++e) {
    if (secants[e] != 0.0) piece[root(bonds.first[e])] = root(bonds.second[e]);
  }
  std::vector<Index> size(piece.size(), 0);
  std::vector<std::uint8_t> is_held(piece.size(), 0);
  for (std::size_t slot = 0; slot < model.unknowns.number.size(); ++slot) {
    const Index own = root(static_cast<Index>(slot / model.unknowns.width));
    if (slot % model.unknowns.width == 0) ++size[own];
    const bool on_spring =
        !model.network.support_stiffness.empty() && model.network.support_stiffness[slot] > 0.0;
    if (on_spring || model.unknowns.number[slot] == no_index) is_held[own] = 1;
  }
  Index loose = 0;
  for (Index i = 0; i < count; ++i) {
    loose += is_held[i] == 0 && size[i] >= std::max(1.0, 0.01 * count);
  }
  return loose;
}

/// Fields and gauges take displacements as they are: the load factor is in them.
StepState present_state(const BondRunState& state, const std::vector<double>& secants) {
  return {state.network, secants, state.motion.displacement};
}

}  // namespace

std::string cracks_text(const Model& model, const ExplicitRecord& record) {
  return model.network.has_states() ? fmt::format("{} cracked particles", record.cracked_particles)
                                    : fmt::format("{} broken bonds", record.broken_bonds);
}

BondRunCase build_bond_run(const CaseFile& input, const Model& model) {
  BondRunCase built;
  built.rules.damping_rate = input.analysis.damping_rate;
  built.rules.strain = input.analysis.strain;
  built.rules.constant_velocity = !input.velocities.empty();
  if (model.network.has_states()) {
    built.rules.states = state_body_of(input);
    refuse_wide_bands(input, model.network.particles, built.rules.states);
  }
  built.inertia =
      lumped_inertia(model.network, densities(input), input.analysis.masses, built.rules.strain);
  choose_steps(input, built);
  return built;
}

BondRunFiles::BondRunFiles(const CaseFile& input, const Model& model, Index steps,
                           std::filesystem::path directory, bool quiet)
    : input_(input),
      model_(model),
      steps_(steps),
      directory_(std::move(directory)),
      history_(directory_.string(), crack_count(input), names_of(model.gauges)),
      bar_(quiet),
      families_(bonds_of_particles(model.network.bonds, model.network.particles.size())),
      peaks_(input.analysis.type == AnalysisType::relaxation ? 1 : vibrating_rows) {}

void BondRunFiles::write_fields(const ExplicitRecord& record, const BondRunState& state) {
  const std::string name = fmt::format("fields_{:06}.vtu", record.step);
  if (!series_.empty() && series_.back().file == name) return;
  const Timer timer;
  const std::vector<double> secants = state.bonds.secants();
  const bool bonds_break = !model_.network.has_states();
  StepRecord at;  // with a load factor of one, since the displacements are those of this moment
  at.step = record.step;
  at.broken_bonds = record.broken_bonds;
  at.load_factor = 1.0;
  at.load = record.load;
  VtuGrid grid = make_field_grid(model_.network, present_state(state, secants), at,
                                 bonds_break ? state.broken : std::vector<Index>{}, families_,
                                 model_.lattice.spacing);
  for (auto& [key, value] : grid.field_data) {
    if (key == "load_factor") value = record.load_factor;
  }
  if (!bonds_break) {
    number_cracks(grid, state.broken);
    for (VtuArray& field : grid.point_data) {
      if (field.name == "damage") field.values = state.bonds.damage();
    }
  }
  grid.field_data.push_back({"time", record.time});
  if (model_.network.dim() == 2) grid.field_data.push_back({"thickness", input_.body.thickness});
  write_vtu((directory_ / name).string(), grid);
  series_.push_back({record.time, name});
  write_pvd((directory_ / "fields.pvd").string(), series_);
  seconds_writing_ += timer.seconds();
}

void BondRunFiles::on_row(const ExplicitRecord& record, const BondRunState& state) {
  std::vector<double> gauges;
  if (!model_.gauges.empty()) {
    const std::vector<double> secants = state.bonds.secants();
    gauges = gauge_values(model_, present_state(state, secants), 1.0);
  }
  history_.append(record, gauges);
  ++rows_;
  const bool intact = record.broken_bonds == 0 && record.cracked_particles == 0;
  peaks_.add({record.displacement, record.load}, intact);
  const double now = record.time * (1.0 + round_off);
  const std::vector<double>& times = input_.output.fields_times;
  bool wanted = rows_ == 1 || input_.analysis.type == AnalysisType::relaxation;
  for (; next_time_ < times.size() && times[next_time_] <= now; ++next_time_) wanted = true;
  if (wanted) write_fields(record, state);
  if (!bar_.is_due()) return;
  bar_.draw(fmt::format("step {} of {}, load factor {:.4g}, {}", record.step, steps_,
                        record.load_factor, cracks_text(model_, record)),
            static_cast<double>(record.step) / steps_);
}

void BondRunFiles::on_end(const ExplicitRecord& last, const BondRunState& state) {
  write_fields(last, state);
  if (!model_.network.has_states()) loose_pieces_ = loose_pieces(model_, state);
}

std::vector<std::string> BondRunFiles::doubts(const ExplicitResult& result) const {
  const Particles& particles = model_.network.particles;
  const double length = longest_side(particles.dim, particles.size(), [&](Index i, int axis) {
    return particles.position(i)[axis];
  });
  RunFacts facts = run_facts(input_, length, peaks_.highest().load);
  facts.loose_pieces = loose_pieces_;
  return doubts_about(result, facts);
}

void BondRunFiles::on_iteration(Index load_step, Index iteration, double residual) {
  if (!bar_.is_due()) return;
  bar_.draw(fmt::format("load step {} of {}, iteration {}, residual {:.1e}", load_step, steps_,
                        iteration, residual),
            static_cast<double>(load_step - 1) / steps_);
}

bool BondRunFiles::stop_requested() { return stop_signal_received(); }

void BondRunFiles::finish() {
  bar_.finish();
  history_.finish();
}

void write_summary(const std::filesystem::path& directory, const CaseFile& input,
                   const Model& model, const ExplicitResult& result, const BondRunFiles& files,
                   const PhaseSeconds& seconds, int threads) {
  const EnergyBalance& energy = result.last.energy;
  nlohmann::ordered_json json;
  json["title"] = input.title;
  json["units"] = input.units;
  json["status"] = to_string(result.ending);
  json["reason"] = result.reason;
  json["peak_load"] = files.peaks().highest().load;
  json["peak_displacement"] = files.peaks().highest().displacement;
  json["first_peak_load"] = files.peaks().first().load;
  json["first_peak_displacement"] = files.peaks().first().displacement;
  json["peak_reaction"] = result.peak_load;
  json["steps"] = result.steps;
  json["rows"] = files.rows();
  json["time_step"] = result.time_step;
  json["critical_time_step"] = result.critical_time_step;
  json["time"] = result.last.time;
  if (model.particle_fit) {
    json["cracked_particles"] = result.last.cracked_particles;
    json["constants"] = fit_json(*model.particle_fit);
  } else {
    json["broken_bonds"] = result.last.broken_bonds;
  }
  json["external_work"] = energy.external_work;
  json["kinetic_energy"] = energy.kinetic;
  json["strain_energy"] = energy.stored;
  json["damped_energy"] = energy.external_damping;
  json["dissipated_energy"] = energy.fractured;
  json["energy_error"] = result.largest_surplus;
  json["particles"] = model.network.particles.size();
  json["bonds"] = model.network.first_segment;
  json["spacing"] = model.lattice.spacing;
  json["horizon"] = model.horizon;
  json["notes"] = model.notes;
  json["doubts"] = files.doubts(result);
  json["seconds"] = {
      {"set_up", seconds.set_up}, {"analysis", seconds.analysis}, {"output", seconds.output}};
  json["peak_memory_bytes"] = peak_memory_bytes();
  json["threads"] = threads;
  json["version"] = program_version();
  json["commit"] = program_commit();
  write_summary_file(directory, json);
}

void print_summary(const std::filesystem::path& directory, const CaseFile& input,
                   const Model& model, const ExplicitResult& result, const BondRunFiles& files,
                   const PhaseSeconds& seconds) {
  const EnergyBalance& energy = result.last.energy;
  const double rate = seconds.analysis > 0.0
                          ? 1.0 * model.network.num_elements() * result.steps / seconds.analysis
                          : 0.0;
  fmt::print("{}\n", input.title.empty() ? input.path : input.title);
  fmt::print("  {:<14} {} ({})\n", "ended", to_string(result.ending), result.reason);
  fmt::print("  {:<14} {:.6g} at displacement {:.6g}{}{}\n", "peak load",
             files.peaks().highest().load, files.peaks().highest().displacement,
             reaction_text(result.peak_load), input.units.empty() ? "" : "  [" + input.units + "]");
  fmt::print("  {:<14} {} of {:.4g} (critical {:.4g}), {} rows\n", "steps", result.steps,
             result.time_step, result.critical_time_step, files.rows());
  fmt::print(
      "  {:<14} {:.6g} work, {:.6g} kinetic at the end, {:.6g} dissipated by {}, balance to "
      "{:.1e}\n",
      "energy", energy.external_work, energy.kinetic, energy.fractured,
      cracks_text(model, result.last), result.largest_surplus);
  fmt::print("  {:<14} {} particles, {}\n", "size", model.network.particles.size(),
             elements_text(model));
  fmt::print(
      "  {:<14} set-up {:.2f} s, analysis {:.2f} s ({:.3g} M bond-steps/s), output {:.2f} s\n",
      "time", seconds.set_up, seconds.analysis, rate / 1e6, seconds.output);
  for (const std::string& note : model.notes) fmt::print("  {:<14} {}\n", "note", note);
  for (const std::string& doubt : files.doubts(result)) {
    fmt::print("  {:<14} {}\n", "doubt", doubt);
  }
  fmt::print("  {:<14} {}\n", "results", directory.string());
}

}  // namespace perilink
