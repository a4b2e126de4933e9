#include "app/run/run_cost.hpp"

#include <algorithm>
#include <cmath>

#include "analysis/quasistatic/subdomains/subdomain_factor.hpp"
#include "app/run/summary.hpp"
#include "base/timer.hpp"

namespace perilink {
namespace {

/// Rough rates of a quiet server core (verification/benchmarks).
constexpr double factor_flops_per_second = 15e9;
/// A factor in the caches is read so fast, and one that is larger than them.
constexpr double read_bytes_per_second = 36e9, read_bytes_beyond_caches = 15e9;
constexpr double bytes_of_caches = 8e6;
/// Passes through the factor for a batch of events: change, solution, sides of closed bonds.
constexpr double passes_per_batch = 2.5;
/// Solutions from the last displacements, for the events and for the sides of closed bonds.
constexpr double solutions_per_batch = 2.0;
constexpr double search_seconds_per_bond = 1e-9;
/// Boxes and some 55 iterations (verification/studies/large_bodies).
constexpr double box_seconds_per_bond = 0.5e-6, box_seconds_per_frame_bond = 3e-6;
constexpr double box_bytes_per_bond = 145.0, box_bytes_per_frame_bond = 580.0, box_bytes = 50e6;
/// Elastic runs with bonds of their own, and with bonds that share their directions (horizons of
/// three spacings, 952 875 unknowns: 1.47 and 0.95 GB; of two, 3 090 231 unknowns: 1.48 GB).
constexpr double elastic_bytes_per_bond = 63.0, elastic_bytes_per_alike_bond = 35.0;
constexpr double elastic_bytes_per_particle = 820.0;
/// An event of the smallest body: row, bookkeeping, progress (meshes/rc_cantilever.toml).
constexpr double seconds_per_row = 15e-6;

/// A field file: compressed, brought to the disk (meshes/block_tension.toml, notched_beam.toml).
constexpr double seconds_per_file = 2e-3, seconds_per_particle_of_file = 1e-6;
/// Columns that a search for more takes beside the window, and how much of a solution an event
/// costs: with brittle trusses a column more, solved for along with others; with bonds that soften
/// several; where bonds carry moments the columns of their unknowns (blocks of 14 807 and 31 382
/// unknowns).
constexpr double columns_beside_window = 64.0, solutions_per_event = 0.13;
constexpr double solutions_per_softening_event = 0.5, solutions_per_event_of_frames = 2.0;

/// Passes through the factor per event. A micropolar bond leaves with three modes in the plane and
/// six in space, which go through the factor together: 1.5 times (blocks of 14 100 and 21 240
/// unknowns) and 3.5 times (7 938 unknowns) the time of a truss per byte of the factor were
/// measured, which itself has two or four times the numbers. Where bonds keep their shear all but
/// the last of their events are those of a truss.
double passes_per_break(const Network& network) {
  if (!network.carries_moments() || network.has_kept_shear()) return 1.0;
  return network.dim() == 2 ? 1.5 : 3.5;
}

/// Part of the particles whose displacements events keep: under forces alone those of bonds that
/// have a limit (Equilibrium::choose_current_unknowns).
double share_that_is_kept(const Network& network) {
  std::vector<std::uint8_t> kept(static_cast<std::size_t>(network.particles.size()), 0);
  for (Index e = 0; e < network.num_elements(); ++e) {
    if (network.has_limit(e)) kept[network.bonds.first[e]] = kept[network.bonds.second[e]] = 1;
  }
  return static_cast<double>(std::count(kept.begin(), kept.end(), 1)) /
         static_cast<double>(kept.size());
}

/// Steps are timed until they take this long.
constexpr double long_enough = 0.02;  // [s]
/// Steps of a run that breaks its body, with its rows and fields, over steps at rest: 1.9 to 2.6 in
/// meshes/moving_block.toml, irregular_plate.toml and splm_tension.toml.
constexpr double breaking = 2.0;

/// Calibrations that are expected to take less are tried [s].
constexpr double short_calibration = 0.5;

bool can_break(const Network& network) {
  if (network.has_states()) return true;
  for (Index e = 0; e < network.num_elements(); ++e) {
    if (network.can_break(e)) return true;
  }
  return false;
}

/// \param run  takes a number of steps; what it sets up before the first cancels out
template <class Run>
double time_of_step(Index most, Run run) {
  const auto seconds = [&](Index steps) {
    const Timer timer;
    run(steps);
    return timer.seconds();
  };
  Index few = 1, many = 16;
  double before = seconds(few), after = seconds(many);
  while (after - before < long_enough && many < most) {
    few = many;
    before = after;
    many = std::min(4 * many, std::max<Index>(most, few + 1));
    after = seconds(many);
  }
  return std::max(after - before, 0.0) / static_cast<double>(many - few);
}

/// So many steps, as the run takes them, with no rows between the first and the last.
ExplicitOptions some_steps(ExplicitOptions options, Index steps) {
  options.duration = options.time_step * static_cast<double>(steps);
  options.rows = 1;
  options.threads = 1;
  return options;
}

}  // namespace

double time_of_calibration(const CaseFile& input, const Model& model) {
  if (!model.network.calibration) return 0.0;
  const CalibrationReport& report = *model.network.calibration;
  const bool done = report.iterations > 0 || report.seconds == 0.0 || report.alike;
  if (done || report.seconds > short_calibration) return report.seconds;
  return build_model(input).network.calibration->seconds;
}

ExpectedCost expected_cost(const Network& network, const FactorStatistics& factor,
                           bool forces_alone) {
  ExpectedCost cost;
  // The draft is behind us: its peak is known.
  cost.memory = std::max(peak_memory_bytes(), 1.3 * factor.bytes + 300.0 * network.num_elements());
  cost.factorization = factor.flops / factor_flops_per_second;
  const double share = forces_alone ? share_that_is_kept(network) : 1.0;
  const double pass = factor.bytes / (factor.bytes > bytes_of_caches ? read_bytes_beyond_caches
                                                                     : read_bytes_per_second);
  const double beside = search_seconds_per_bond * network.num_elements() + seconds_per_row;
  cost.broken_bond = passes_per_break(network) * share * 1.1 * pass + beside;
  cost.batch = passes_per_batch * pass + 4.0 * beside;
  cost.field_file = seconds_per_file + seconds_per_particle_of_file * network.particles.size();
  return cost;
}

Index field_files(const OutputSection& output, Index broken_bonds) {
  Index files = 2;  // first and last row
  for (const int at : output.fields_at) files += at < broken_bonds ? 1 : 0;
  if (output.fields_every) files += broken_bonds / *output.fields_every;
  if (output.fields_every_rows) files += broken_bonds / *output.fields_every_rows;
  return files;
}

ExpectedCost expected_cost_of_subdomains(const Network& network, bool events) {
  const double bonds = network.num_elements();
  ExpectedCost cost;
  const bool frames = network.carries_moments();
  const bool bars = !frames && !events;
  const double bond_bytes = frames                       ? box_bytes_per_frame_bond
                            : events                     ? box_bytes_per_bond
                            : network.bonds.kind.empty() ? elastic_bytes_per_bond
                                                         : elastic_bytes_per_alike_bond;
  cost.memory = box_bytes + bonds * bond_bytes;
  if (bars) cost.memory += elastic_bytes_per_particle * network.particles.size();
  cost.factorization = bonds * (frames ? box_seconds_per_frame_bond : box_seconds_per_bond);
  cost.field_file = seconds_per_file + seconds_per_particle_of_file * network.particles.size();
  if (!events) return cost;
  const double unknowns = static_cast<double>(network.particles.size()) * network.width();
  const std::size_t window = columns_of_window(static_cast<std::size_t>(unknowns));
  cost.memory += 8.0 * unknowns * (static_cast<double>(window) + columns_beside_window);
  const bool softens = network.laws.size() > 1 || !network.laws[0].is_brittle();
  const double solutions = frames    ? solutions_per_event_of_frames
                           : softens ? solutions_per_softening_event
                                     : solutions_per_event;
  cost.broken_bond = solutions * cost.factorization + seconds_per_row;
  cost.batch = solutions_per_batch * cost.factorization;
  return cost;
}

double seconds_per_step(const Model& model, const BondRunCase& built) {
  const double at_rest = time_of_step(built.options.steps(), [&](Index steps) {
    BondRunObserver silent;
    run_explicit_bonds(model, built.inertia, built.rules, some_steps(built.options, steps), silent);
  });
  return can_break(model.network) ? breaking * at_rest : at_rest;
}

double seconds_per_step(const ExplicitCase& built) {
  const double at_rest = time_of_step(built.options.steps(), [&](Index steps) {
    ExplicitState state(built.model);
    ExplicitObserver silent;
    run_explicit_analysis(built.model, state, some_steps(built.options, steps), silent);
  });
  return built.model.material.breakable ? breaking * at_rest : at_rest;
}

}  // namespace perilink
