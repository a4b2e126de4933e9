#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "analysis/dynamics/fundamental_period.hpp"
#include "analysis/dynamics/lattice/body/lattice_statics.hpp"
#include "analysis/quasistatic/subdomains/subdomain_factor.hpp"
#include "app/commands/check_conditions.hpp"
#include "app/commands/check_sizes.hpp"
#include "app/commands/commands.hpp"
#include "app/process/progress.hpp"
#include "app/process/threads.hpp"
#include "app/run/bond_run.hpp"
#include "app/run/summary.hpp"
#include "assembly/stiffness.hpp"
#include "base/error.hpp"
#include "base/plain_text.hpp"
#include "base/timer.hpp"
#include "io/case/case_settings.hpp"
#include "io/case/sections/case_kinds.hpp"
#include "model/expected_events.hpp"
#include "model/from_case/configure.hpp"
#include "model/from_case/lattice_case.hpp"
#include "model/from_case/separated_body.hpp"
#include "network/builder/free_bodies.hpp"
#include "solver/factor_routes.hpp"

namespace perilink {
namespace {

/// Rate at which one core reads a factor: verification/benchmarks/README.md.
constexpr double read_bytes_per_second = 31.5e9;
/// `check` computes neither the fundamental period nor calibrated bonds of larger bodies.
constexpr Index most_particles = 20000;

std::string time_text(double seconds) {
  return seconds < 10.0 ? fmt::format("{:.2g} s", seconds) : format_duration(seconds);
}

/// Whether bonds fail by more than one event.
bool softens(const Network& network) {
  const auto many = [](const MaterialStrength& strength) { return strength.segments > 1; };
  return std::any_of(network.report.strengths.begin(), network.report.strengths.end(), many) ||
         std::any_of(network.report.interfaces.begin(), network.report.interfaces.end(),
                     [&](const InterfaceBonds& face) { return many(face.strength); });
}

/// Estimates the memory of a run with conjugate gradients instead of a factor [bytes]. The figures
/// were fitted to the bodies of verification/studies/large_bodies.
double memory_without_factor(const Network& network, bool events) {
  const double bonds = network.num_elements(), particles = network.particles.size();
  const bool moments = network.carries_moments();
  if (!events && !moments) {
    return 50e6 + bonds * (network.bonds.kind.empty() ? 63.0 : 35.0) + 820.0 * particles;
  }
  const double boxes = 50e6 + bonds * (moments ? 580.0 : 145.0);
  if (!events) return boxes;
  const double unknowns = particles * network.width();
  const std::size_t columns = 64 + columns_of_window(static_cast<std::size_t>(unknowns));
  return boxes + 8.0 * unknowns * static_cast<double>(columns);
}

/// Estimates the time of a batch without a factor [s]. Rates are those of
/// verification/studies/large_bodies, iterations those of the prism of
/// verification/studies/event_tolerance.
double seconds_without_factor(const Network& network) {
  constexpr double iterations = 80.0, per_particle = 7.4e-8, per_element = 1.4e-9;
  return iterations *
         (per_particle * network.particles.size() + per_element * network.num_elements());
}

bool fails_in_batches(const CaseFile& input, const Network& network) {
  return softens(network) && event_tolerance_of(input) > 0.0;
}

/// Prints the time per event, which reads the factor twice, and of one crack across the body. A
/// batch takes `batch_share` times as long, and `batch_seconds` for its elements. Both were fitted
/// to verification/studies/event_tolerance.
/// \param factor  empty: batches without a factor
void print_time_of_events(const CaseFile& input, const Network& network,
                          const std::optional<FactorStatistics>& factor) {
  constexpr double batch_share = 1.7, batch_seconds = 8e-5;
  const bool many = softens(network), batches = fails_in_batches(input, network);
  const double seconds = factor ? 2.0 * factor->bytes / read_bytes_per_second : 0.0;
  const double each = !factor   ? seconds_without_factor(network)
                      : batches ? batch_share * seconds + batch_seconds
                                : seconds;
  const char* event = batches ? "batch of events" : many ? "event" : "broken bond";
  fmt::print("#   time               about {:.2g} ms per {}{}", 1e3 * each, event,
             input.elements ? " at first" : "");
  if (input.stop.broken_bonds && !many) {
    fmt::print(", {} for {} of them", time_text(*input.stop.broken_bonds * each),
               *input.stop.broken_bonds);
  } else if (const auto crack = expected_crack(network)) {
    const double tolerance = batches ? event_tolerance_of(input) : 0.0;
    const double count = crack->events / expected_batch(crack->events, tolerance, network.dim());
    const double unit = std::pow(10.0, std::max(0.0, std::floor(std::log10(count)) - 1.0));
    const bool has_bars = network.first_slip_spring < network.num_elements();
    fmt::print("; {} for {} crack across the body, about {:.0f} of them", time_text(count * each),
               has_bars ? "each" : "a", unit * std::round(count / unit));
  }
  fmt::print("\n");
}

/// \param factor  of the stiffness matrix; empty where the run uses conjugate gradients
void print_cost(const CaseFile& input, const Network& network,
                const std::optional<FactorStatistics>& factor) {
  const bool events = input.analysis.type != AnalysisType::elastic;
  fmt::print("# expected cost of a run\n");
  double memory = network.report.calibration ? network.report.calibration->bytes : 0.0;
  if (factor) {
    fmt::print("#   factor             {:.3g} M numbers, {:.3g} MB\n", factor->entries / 1e6,
               factor->bytes / 1e6);
    // The uncalibrated model of this process counts in its peak memory.
    memory = std::max(
        {memory, peak_memory_bytes(), 1.3 * factor->bytes + 300.0 * network.num_elements()});
  } else {
    fmt::print("#   solver             conjugate gradients with subdomains, {}\n",
               input.analysis.solver == LinearSolver::iterative
                   ? "as asked for"
                   : "faster than a factor for so many unknowns");
    memory = std::max(memory, memory_without_factor(network, events));
  }
  fmt::print("#   memory             {:.3g} GB\n", memory / 1e9);
  const bool searches = fails_in_batches(input, network) && !network.carries_moments();
  if (events && (factor || searches)) print_time_of_events(input, network, factor);
  if (events && softens(network)) {
    const char* wider = event_tolerance_of(input) < 0.02 ? "event_tolerance = 0.02, " : "";
    fmt::print(
        "#   faster             {}a larger softening_error, [elements] "
        "where\n#                      no crack runs, control = \"steps\", or "
        "type = \"explicit\"\n",
        wider);
  }
}

/// Prints the fundamental period, a time scale for choosing how slowly to load.
/// \param period  computes it
/// \param ramp    time in which the load grows
template <class Period>
void print_period(Index particles, double ramp, Period period) {
  if (particles > most_particles) {
    fmt::print("#   fundamental period not computed for more than {} particles\n", most_particles);
    return;
  }
  try {
    const double time = period();
    fmt::print("#   fundamental period {:.6g}{}\n", time,
               ramp < time
                   ? fmt::format(", ramp_time is {:.2g} of it: no quasistatic run", ramp / time)
                   : "");
  } catch (const SolverError& error) {
    fmt::print("#   fundamental period not found: {}\n", error.what());
  }
}

/// \param run  advances the analysis by a number of steps
template <class Run>
void print_steps(double critical_time_step, ExplicitOptions options, const char* remark, Run run) {
  fmt::print("#   critical time step {:.6g}{}\n", critical_time_step, remark);
  fmt::print("#   time step          {:.6g}\n", options.time_step);
  const Index steps = options.steps();
  fmt::print("#   steps              {}, about {} of history\n", steps,
             counted(std::min<Index>(steps, options.rows), "row"));
  const auto seconds = [&](Index count) {
    options.duration = options.time_step * static_cast<double>(count);
    options.rows = options.threads = 1;
    const Timer timer;
    run(options);
    return timer.seconds();
  };
  seconds(1);  // fills the caches
  const double first = seconds(1);
  Index timed = 8;
  double taken = 0.0;
  do {
    timed *= 4;
    taken = seconds(1 + timed) - first;
  } while (taken < 0.05 && timed < steps);
  fmt::print("# expected cost of a run\n#   memory             {:.3g} GB\n",
             peak_memory_bytes() / 1e9);
  fmt::print(
      "#   time               {} on one core, measured over {} steps of the "
      "intact body\n",
      time_text(taken / static_cast<double>(timed) * static_cast<double>(steps)), timed);
}

void print_case(const std::string& path, const CaseFile& input) {
  fmt::print("# {}: the case as resolved\n\n{}\n", path, write_case(input));
}

void print_body(const CaseFile& input, const Model& model) {
  print_sizes(model, input.analysis.type == AnalysisType::damage);
  print_bars(input, model);
  print_regions(input, model);
  print_symmetry(input, model);
  print_stages(input, model);
  print_crack_tips(input, model);
}

int check_explicit(const std::string& case_path, const CaseFile& input) {
  const ExplicitCase built = build_explicit_case(input);
  const ExplicitModel& model = built.model;
  const auto count = [](const auto& rows) {
    std::size_t sum = 0;
    for (const auto& row : rows) sum += row.size();
    return sum;
  };
  print_case(case_path, input);
  fmt::print("# sizes\n");
  fmt::print("#   particles          {} in {}\n", model.lattice.particles(),
             counted(model.lattice.rows.size(), "row"));
  fmt::print("#   spacing            {:.6g}\n", model.lattice.spacing);
  print_regions(input, built.places);
  fmt::print("#   bonds              {}\n", built.bonds);
  fmt::print("#   prescribed         {}\n", counted(count(model.prescribed), "displacement"));
  if (model.material.breakable) {
    const CrackOpeningLaw& law = model.material.softening;
    fmt::print("#   softening          fracture energy {:.6g}, critical opening {:.6g}\n",
               fracture_energy(law), law.critical_opening);
  }
  if (const std::size_t loaded = count(model.applied); loaded > 0) {
    fmt::print("#   forces             {} on components of particles\n", loaded);
  }
  for (const std::string& note : built.notes) fmt::print("#   note               {}\n", note);
  const double ramp = built.options.ramp;
  print_period(built.fundamental_period > 0.0 ? 0 : model.lattice.particles(), ramp, [&] {
    return built.fundamental_period > 0.0 ? built.fundamental_period : fundamental_period(model);
  });
  print_steps(built.critical_time_step, built.options, "", [&](const ExplicitOptions& options) {
    ExplicitState state(model);
    ExplicitObserver silent;
    run_explicit_analysis(model, state, options, silent);
  });
  return exit_done;
}

int check_moving_bonds(const std::string& case_path, const CaseFile& input) {
  Model model = draft_model(input);
  // The calibration changes the critical time step.
  const bool changes = input.body.surface == Surface::calibrated;
  const bool builds = input.analysis.time_step || model.network.particles.size() <= most_particles;
  if (changes && builds) model = build_model_visibly(input, false);
  const BondRunCase built = build_bond_run(input, model);
  print_case(case_path, input);
  print_body(input, model);
  std::fflush(stdout);
  const double ramp = input.velocities.empty() ? built.options.ramp : infinity;
  print_period(model.network.particles.size(), ramp, [&] {
    const auto free = free_motions(model.network, model.unknowns);
    return fundamental_period(model.network, model.unknowns, built.inertia, free);
  });
  print_steps(built.inertia.critical_time_step(), built.options,
              changes && !builds ? " before bonds are calibrated" : "",
              [&](const ExplicitOptions& options) {
                BondRunObserver silent;
                run_explicit_bonds(model, built.inertia, built.rules, options, silent);
              });
  return exit_done;
}

int check_relaxation(const std::string& case_path, const CaseFile& input) {
  const Model model = draft_model(input);
  print_case(case_path, input);
  print_body(input, model);
  fmt::print("#   load steps         {}\n", input.analysis.load_factors.size());
  fmt::print("# expected cost of a run\n#   memory             {:.3g} GB\n",
             peak_memory_bytes() / 1e9);
  return exit_done;
}

}  // namespace

int check_case(const RunOptions& options) {
  set_threads(0);
  const std::string& case_path = options.case_path;
  CaseFile input = read_case_file(case_path, parse_settings(options.settings), {});
  input.trust_geometry = options.trust_geometry;
  if (input.analysis.type == AnalysisType::explicit_) {
    return input.body.model == BodyModel::lattice ? check_explicit(case_path, input)
                                                  : check_moving_bonds(case_path, input);
  }
  if (input.analysis.type == AnalysisType::relaxation) return check_relaxation(case_path, input);
  Model model = draft_model(input);
  if (const auto note = note_of_separated_body(input, model, 1)) model.notes.push_back(*note);
  print_case(case_path, input);
  print_body(input, model);
  std::fflush(stdout);  // ordering the unknowns of a large body takes long

  const Network& network = model.network;
  std::optional<FactorStatistics> factor;
  const bool by_boxes = input.analysis.type == AnalysisType::damage
                            ? is_followed_by_subdomains(model, damage_options(input, 1).engine)
                            : is_for_subdomains(model, input.analysis.solver);
  if (model.elements || !by_boxes) {
    factor =
        estimate_factor(assemble_stiffness(network, {}, model.unknowns), model.unknowns.owners());
  }
  print_cost(input, network, factor);
  return exit_done;
}

}  // namespace perilink
