#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "analysis/dynamics/fundamental_period.hpp"
#include "analysis/dynamics/lattice/body/lattice_statics.hpp"
#include "app/commands/check_sizes.hpp"
#include "app/commands/commands.hpp"
#include "app/model/from_case/configure.hpp"
#include "app/model/from_case/lattice_case.hpp"
#include "app/process/progress.hpp"
#include "app/process/threads.hpp"
#include "app/run/bond_run.hpp"
#include "app/run/relaxation_run.hpp"
#include "app/run/run_cost.hpp"
#include "app/run/separated_body.hpp"
#include "app/run/summary.hpp"
#include "assembly/stiffness.hpp"
#include "base/error.hpp"
#include "base/timer.hpp"
#include "discretization/lattices/triangulate.hpp"
#include "io/case/sections/case_kinds.hpp"
#include "network/builder/free_bodies.hpp"
#include "solver/factor_routes.hpp"

namespace perilink {
namespace {

std::string time_text(double seconds) {
  return seconds < 10.0 ? fmt::format("{:.2g} s", seconds) : format_duration(seconds);
}

/// Whether bonds give way by more than one event.
bool softens(const Network& network) {
  const auto many = [](const MaterialStrength& strength) { return strength.segments > 1; };
  return std::any_of(network.strengths.begin(), network.strengths.end(), many) ||
         std::any_of(network.interfaces.begin(), network.interfaces.end(),
                     [&](const InterfaceBonds& face) { return many(face.strength); });
}

/// The whole run as far as the case tells its length.
std::string run_text(const CaseFile& input, double set_up, const ExpectedCost& cost,
                     bool softening) {
  const double begin = set_up + cost.factorization + cost.field_file;  // the first row has one
  if (input.analysis.type == AnalysisType::elastic) return "about " + time_text(begin);
  if (softening) {
    return fmt::format(
        "about {} until the first event; how many there will be nothing tells: "
        "bodies that soften have hundreds to thousands of batches",
        time_text(begin));
  }
  if (!input.stop.broken_bonds) {
    return fmt::format("about {} until the first bond breaks; the case does not tell how many will",
                       time_text(begin));
  }
  const int count = *input.stop.broken_bonds;
  const double later = (field_files(input.output, count) - 1) * cost.field_file;
  return fmt::format("about {} to {} broken bonds",
                     time_text(begin + count * cost.broken_bond + later), count);
}

void print_set_up(const ExpectedSetUp& set_up) {
  fmt::print("#   set-up             {}", time_text(set_up.seconds()));
  if (set_up.calibration > 0.0) {
    fmt::print(", of it calibration {}", time_text(set_up.calibration));
  }
  fmt::print("\n");
}

/// \param factor  that of the stiffness; none where conjugate gradients need none
void print_cost(const CaseFile& input, const Network& network,
                const std::optional<FactorStatistics>& factor, const ExpectedSetUp& set_up) {
  const bool events = input.analysis.type != AnalysisType::elastic;
  const ExpectedCost cost =
      factor ? expected_cost(network, *factor, input.displacements.empty() && input.stages.empty())
             : expected_cost_of_boxes(network, events);
  fmt::print("# expected cost of a run\n");
  if (factor) {
    fmt::print("#   factor             {:.3g} M numbers, {:.3g} MB\n", factor->entries / 1e6,
               factor->bytes / 1e6);
  } else {
    fmt::print("#   solver             conjugate gradients with boxes, {}\n",
               input.analysis.solver == LinearSolver::iterative
                   ? "as asked for"
                   : "faster than a factor for so many unknowns");
  }
  const double to_calibrate = network.calibration ? network.calibration->bytes : 0.0;
  fmt::print("#   memory             {:.3g} GB\n", std::max(cost.memory, to_calibrate) / 1e9);
  print_set_up(set_up);
  fmt::print("#   {:<18} {}\n", factor ? "factorisation" : "solution",
             time_text(cost.factorization));
  const bool batches = softens(network) && event_tolerance_of(input) > 0.0;
  const double each = batches ? cost.batch : cost.broken_bond;
  if (events) {
    fmt::print("#   {:<18} {:.3g} ms{}; 1000 of them {}\n",
               batches            ? "each batch"
               : softens(network) ? "each event"
                                  : "each broken bond",
               1e3 * each, input.elements ? " at first" : "", time_text(1e3 * each));
  }
  fmt::print("#   run                {}\n",
             run_text(input, set_up.seconds(), cost, softens(network)));
  if (events && softens(network)) {
    const char* wider = event_tolerance_of(input) < 0.02 ? "event_tolerance = 0.02, " : "";
    fmt::print(
        "#   faster             {}[elements] where nothing cracks, control = \"steps\", or\n"
        "#                      type = \"explicit\"\n",
        wider);
  }
}

/// Prints the fundamental period, with which loading times are compared, but of bodies for which it
/// takes longer than all the rest.
/// \param period  computes it
template <class Period>
void print_period(Index particles, Period period) {
  constexpr Index most_particles = 20000;
  if (particles > most_particles) {
    fmt::print("#   fundamental period not computed for so many particles\n");
    return;
  }
  try {
    fmt::print("#   fundamental period {:.6g}\n", period());
  } catch (const SolverError& error) {
    fmt::print("#   fundamental period not found: {}\n", error.what());
  }
}

/// From the first to the last particle; the cells of the outermost reach beyond.
void print_extents(const LatticeRows& lattice) {
  std::string text;
  for (int axis = 0; axis < lattice.dim; ++axis) {
    double lower = INFINITY, upper = -INFINITY;
    for (const Index slot : lattice.particle_slot) {
      lower = std::min(lower, lattice.positions[lattice.at(axis, slot)]);
      upper = std::max(upper, lattice.positions[lattice.at(axis, slot)]);
    }
    text += fmt::format("{}{} {:.6g} to {:.6g}", axis > 0 ? ", " : "", "xyz"[axis], lower, upper);
  }
  fmt::print("#   particles lie in   {}\n", text);
}

void print_steps(double critical_time_step, const ExplicitOptions& options,
                 const char* remark = "") {
  fmt::print("#   critical time step {:.6g}{}\n", critical_time_step, remark);
  fmt::print("#   time step          {:.6g}\n", options.time_step);
  fmt::print("#   steps              {}, about {} rows of history\n", options.steps(),
             std::min<Index>(options.steps(), options.rows));
  fmt::print("# expected cost of a run\n");
}

void print_case(const std::string& path, const CaseFile& input) {
  fmt::print("# {}: the case as resolved\n\n{}\n", path, write_case(input));
}

int check_explicit(const std::string& case_path, const CaseFile& input) {
  const Timer timer;
  const ExplicitCase built = build_explicit_case(input);
  const ExplicitModel& model = built.model;
  const ExplicitState state(model);  // what a run holds in memory
  const double set_up = timer.seconds();
  std::size_t prescribed = 0;
  for (const auto& row : model.prescribed) prescribed += row.size();
  print_case(case_path, input);
  fmt::print("# sizes\n");
  fmt::print("#   particles          {} in {} rows\n", model.lattice.particles(),
             model.lattice.rows.size());
  fmt::print("#   spacing            {:.6g}\n", model.lattice.spacing);
  print_extents(model.lattice);
  fmt::print("#   bonds              {}\n", built.bonds);
  fmt::print("#   prescribed         {} displacements\n", prescribed);
  if (model.material.breakable) {
    const CrackOpeningLaw& law = model.material.softening;
    fmt::print("#   softening          fracture energy {:.6g}, critical opening {:.6g}\n",
               fracture_energy(law), law.critical_opening);
  }
  std::size_t loaded = 0;
  for (const auto& row : model.applied) loaded += row.size();
  if (loaded > 0) fmt::print("#   forces             {} on components of particles\n", loaded);
  for (const std::string& note : built.notes) fmt::print("#   note               {}\n", note);
  print_period(built.fundamental_period > 0.0 ? 0 : model.lattice.particles(), [&] {
    return built.fundamental_period > 0.0 ? built.fundamental_period : fundamental_period(model);
  });
  print_steps(built.critical_time_step, built.options);
  fmt::print("#   memory             {:.3g} GB\n", peak_memory_bytes() / 1e9);
  fmt::print("#   set-up             {} (as it took now)\n", time_text(set_up));
  fmt::print("#   run                about {} on one core{}\n",
             time_text(set_up + built.options.steps() * seconds_per_step(built)),
             model.material.breakable ? ", more where much cracks" : "");
  return exit_done;
}

/// Rough rate of one core: verification/benchmarks/explicit_step has 211 to 293 million.
constexpr double bond_steps_per_second = 250e6;
constexpr double soon = 2.0;  // seconds of a calibration that is not left to the run

int check_moving_bonds(const std::string& case_path, const CaseFile& input) {
  const Timer timer;
  Model model = draft_model(input);
  const ExpectedSetUp set_up{timer.seconds(), time_of_calibration(input, model)};
  // Calibrated bonds have another critical time step than those of a draft.
  const bool changes = input.body.surface == Surface::calibrated;
  const bool calibrated = changes && (input.analysis.time_step || set_up.calibration < soon);
  if (calibrated) model = build_model_visibly(input, false);
  const BondRunCase built = build_bond_run(input, model);
  print_case(case_path, input);
  print_sizes(model);
  std::fflush(stdout);
  print_period(model.network.particles.size(), [&] {
    const auto free = free_motions(model.network, model.unknowns);
    return fundamental_period(model.network, model.unknowns, built.inertia, free);
  });
  print_steps(built.inertia.critical_time_step(), built.options,
              changes && !calibrated ? " before bonds are calibrated" : "");
  print_set_up(set_up);
  fmt::print("#   run                about {} on one core\n",
             time_text(set_up.seconds() + built.options.steps() * seconds_per_step(model, built)));
  return exit_done;
}

int check_relaxation(const std::string& case_path, const CaseFile& input) {
  const Timer timer;
  const Model model = draft_model(input);
  const double drafted = timer.seconds();
  const ExpectedSetUp set_up{drafted, time_of_calibration(input, model)};
  double iterations = 0.0;
  std::string unknown;  // why the iterations are, which the run itself finds out
  try {
    iterations = expected_iterations(model, relaxation_options(input, 1));
  } catch (const SolverError& error) {
    unknown = error.what();
  }
  print_case(case_path, input);
  print_sizes(model);
  fmt::print("#   load steps         {}, the first of {} iterations\n",
             input.analysis.load_factors.size(),
             unknown.empty() ? fmt::format("about {:.2g}", iterations) : "an unknown number of");
  const double step = model.network.num_elements() * iterations / bond_steps_per_second;
  fmt::print("# expected cost of a run\n");
  print_set_up(set_up);
  fmt::print("#   first load step    {}\n",
             unknown.empty() ? fmt::format("about {} on one core", time_text(step)) : unknown);
  return exit_done;
}

}  // namespace

int check_case(const std::string& case_path, bool trust_geometry) {
  set_threads(0);
  CaseFile input = read_case_file(case_path);
  input.trust_geometry = trust_geometry;
  if (input.analysis.type == AnalysisType::explicit_) {
    return input.body.model == BodyModel::lattice ? check_explicit(case_path, input)
                                                  : check_moving_bonds(case_path, input);
  }
  if (input.analysis.type == AnalysisType::relaxation) return check_relaxation(case_path, input);
  const Timer timer;
  Model model = draft_model(input);
  const double drafted = timer.seconds();
  const ExpectedSetUp set_up{drafted, time_of_calibration(input, model)};
  if (const auto note = note_of_separated_body(input, model, 1)) model.notes.push_back(*note);
  print_case(case_path, input);
  print_sizes(model, input.analysis.type == AnalysisType::damage);
  std::fflush(stdout);  // the order of the unknowns of a large body takes a while

  const Network& network = model.network;
  std::optional<FactorStatistics> factor;
  const bool by_boxes = input.analysis.type == AnalysisType::damage
                            ? is_followed_by_boxes(model, damage_options(input, 1).engine)
                            : is_for_boxes(model, input.analysis.solver);
  if (model.elements || !by_boxes) {
    factor =
        estimate_factor(assemble_stiffness(network, {}, model.unknowns), model.unknowns.owners());
  }
  print_cost(input, network, factor, set_up);
  return exit_done;
}

}  // namespace perilink
