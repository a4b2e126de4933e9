// Elastic equilibria of growing bodies by a factor and by conjugate gradients with boxes: time,
// memory and iterations.
//
//   large_bodies           all bodies, one after the other; writes result.csv
//   large_bodies quick     those below 300 000 unknowns, prints only
//   large_bodies events [COLUMNS [EVENTS [direct|boxes [SCENE]]]]
//                          events of all scenes, or one, without a factor, and with one beside it
//
// Exit status 1 when iterations grow by more than 15 % from the smallest body of a series to the
// largest, or events differ. Six minutes, and 6 GB for the largest factor.

#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

#include "analysis/quasistatic/damage_analysis.hpp"
#include "analysis/quasistatic/elastic_analysis.hpp"
#include "app/process/threads.hpp"
#include "app/run/summary.hpp"
#include "base/timer.hpp"
#include "io/case/case_file.hpp"
#include "model/from_case/configure.hpp"
#include "problems/program.hpp"
#include "problems/result.hpp"

namespace perilink::verification {
namespace {

struct Series {
  std::string name;
  bool space;
  std::string heading;  ///< in [body]
  double horizon_ratio;
  std::vector<int> columns;
  int largest_factor;  ///< columns up to which a factor is made as well
  std::string material = {};
};

const std::vector<Series> all_series = {
    {"cubic", true, "", 2.0, {18, 26, 38, 55, 80}, 26},
    {"cubic", true, "", 3.0, {18, 25, 36, 54, 78}, 18},
    {"cubic micropolar",
     true,
     "model = \"micropolar\"\n",
     2.0,
     {14, 20, 30},
     14,
     "poissons_ratio = 0.1\n"},
    {"square", false, "", 3.0, {100, 200, 400, 740}, 400},
    {"hexagonal", false, "pattern = \"hexagonal\"\n", 3.0, {100, 200, 400, 740}, 400},
    {"square micropolar",
     false,
     "model = \"micropolar\"\n",
     3.0,
     {100, 200, 400},
     200,
     "poissons_ratio = 0.2\n"}};

/// Twice as high as wide, held below, its upper end driven along y, with a notch in the middle that
/// is half as deep as the body is wide.
/// \param breaks  lines of the material that say when bonds break
/// \param along   in which its upper end is driven: across, it is a beam that bends
std::string case_text(const Series& series, int columns,
                      const std::string& breaks = "fracture_energy = \"infinite\"\n",
                      const char* along = "y") {
  const double width = columns, height = 2.0 * columns, deep = columns;
  const auto region = [&](const char* name, double from, double to) {
    return fmt::format("[[regions]]\nname = \"{}\"\nx = [0, {}]\ny = [{}, {}]\n{}", name, width,
                       from, to, series.space ? fmt::format("z = [0, {}]\n", deep) : "");
  };
  const double y = 0.5 * height + 0.02, tip = 0.5 * width;
  return fmt::format("[body]\nspacing = 1\nhorizon_ratio = {}\n{}{}", series.horizon_ratio,
                     series.space ? "problem = \"three_dimensional\"\n" : "", series.heading) +
         region("block", 0, height) + region("base", 0, 2) + region("cap", height - 2, height) +
         "[[materials]]\nregion = \"block\"\nyoungs_modulus = 30000\n" + breaks + series.material +
         "[[supports]]\nregion = \"base\"\nfix = [\"x\", \"y\"" + (series.space ? ", \"z\"" : "") +
         "]\n[[displacements]]\nregion = \"cap\"\n" + along + " = 1\n" +
         (series.space
              ? fmt::format(
                    "[[cracks]]\ncorners = [[-1, {0}, -1], [{1}, {0}, -1], [{1}, {0}, {2}], "
                    "[-1, {0}, {2}]]\n",
                    y, tip, deep + 1)
              : fmt::format("[[cracks]]\npoints = [[-1, {0}], [{1}, {0}]]\n", y, tip)) +
         "[analysis]\n";
}

/// Seconds of the processor, by all threads, and of the clock on the wall.
struct Clocks {
  double processor = seconds_of(CLOCK_PROCESS_CPUTIME_ID), wall = seconds_of(CLOCK_MONOTONIC);

  static double seconds_of(clockid_t clock) {
    timespec now{};
    clock_gettime(clock, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
  }
};

/// Rows of a run that ends when there are enough of them.
struct Events final : StepObserver {
  struct Enough {};
  explicit Events(Index count) : most(static_cast<std::size_t>(count) + 1) {}
  void on_step(const StepRecord& record, StateSource&) override {
    rows.push_back(record);
    clocks.push_back(Clocks());
    if (rows.size() == most) throw Enough();
  }
  std::size_t most;
  std::vector<StepRecord> rows;
  std::vector<Clocks> clocks;
};

std::vector<StepRecord> follow(const Model& model, LinearSolver solver, Index count) {
  DamageOptions options;
  options.engine.solver = solver;
  Events events(count);
  const Clocks start;
  try {
    run_damage_analysis(model, options, events);
  } catch (const Events::Enough&) {
  }
  const Clocks& first = events.clocks.front();
  const Clocks& last = events.clocks.back();
  const double count_of_events = static_cast<double>(events.rows.size() - 1);
  fmt::print(",{},{:.2f},{:.1f},{:.1f},{:.2f}", events.rows.size() - 1, first.wall - start.wall,
             1e3 * (last.wall - first.wall) / count_of_events,
             1e3 * (last.processor - first.processor) / count_of_events, peak_memory_bytes() / 1e9);
  std::fflush(stdout);
  return events.rows;
}

struct EventScene {
  std::string name;
  Series series;
  const char* along;
  std::string breaks;
};

/// Bonds that scatter by nothing, so that symmetry makes ties, break one after the other.
/// \param only  name of the scene to go through, or empty
bool compare_events(int columns, Index count, bool direct, const std::string& only) {
  const std::string brittle = "fracture_energy = 0.1\n";
  const Series three{"cubic", true, "", 3.0, {}, 0}, two{"cubic", true, "", 2.0, {}, 0};
  const Series frames{"cubic micropolar",      true, "model = \"micropolar\"\n", 2.0, {}, 0,
                      "poissons_ratio = 0.1\n"};
  const EventScene scenes[] = {
      {"pulled", three, "y", brittle},
      {"bent", three, "x", brittle},
      {"softening", three, "y", "fracture_energy = 0.1\ntensile_strength = 3\nclosing = false\n"},
      {"short horizon", two, "y", brittle},
      {"micropolar", frames, "y", brittle}};
  fmt::print(
      "scene,unknowns,events,start,ms_per_event,processor_ms,peak_gigabytes{},other_element,"
      "load_factor_difference\n",
      direct ? ",events,start,ms_per_event,processor_ms,peak_gigabytes" : "");
  bool good = true;
  for (const EventScene& scene : scenes) {
    if (!only.empty() && only != scene.name) continue;
    const Model model = build_model(
        parse_case(case_text(scene.series, columns, scene.breaks, scene.along), "body"));
    fmt::print("{},{}", scene.name, model.unknowns.count);
    const std::vector<StepRecord> found = follow(model, LinearSolver::iterative, count);
    Index other = 0;
    double largest = 0.0;
    if (direct) {
      const std::vector<StepRecord> expected = follow(model, LinearSolver::direct, count);
      for (std::size_t k = 0; k < std::min(found.size(), expected.size()); ++k) {
        if (found[k].element != expected[k].element) ++other;
        largest = std::max(largest, std::abs(found[k].load_factor / expected[k].load_factor - 1.0));
      }
      good = good && other == 0 && largest < 1e-9 && found.size() == expected.size();
    }
    fmt::print(",{},{:.1e}\n", other, largest);
    std::fflush(stdout);
  }
  return good;
}

/// By one thread.
std::string measure(const Series& series, int columns, LinearSolver solver) {
  set_threads(1);
  const Timer timer;
  const Model model =
      build_model(parse_case(case_text(series, columns) + "type = \"elastic\"\n", "body"));
  const double set_up = timer.seconds(), calibration = model.network.report.calibration->seconds;
  const ElasticResult found = run_elastic_analysis(model, {.threads = 1, .solver = solver});
  const ElasticSeconds& took = found.seconds;
  return fmt::format("{},{},{},{},{},{:.3f},{:.3f},{:.3f},{:.3f},{:.1e},{:.2f}\n", series.name,
                     series.horizon_ratio, model.unknowns.count,
                     solver == LinearSolver::direct ? "factor" : "boxes", found.iterations, set_up,
                     calibration, took.assembly + took.factorization, took.solve, found.residual,
                     peak_memory_bytes() / 1e9);
}

/// In a process of its own, so that its peak of memory is its own.
std::string measure_apart(const Series& series, int columns, LinearSolver solver) {
  int ends[2];
  if (pipe(ends) != 0) throw std::runtime_error("no pipe");
  const pid_t child = fork();
  if (child < 0) throw std::runtime_error("no process");
  if (child == 0) {
    const std::string line = measure(series, columns, solver);
    const bool written = write(ends[1], line.data(), line.size()) >= 0;
    _exit(written ? 0 : 1);
  }
  close(ends[1]);
  std::string line(400, '\0');
  const ssize_t size = read(ends[0], line.data(), line.size());
  close(ends[0]);
  int status = 0;
  waitpid(child, &status, 0);
  if (status != 0 || size <= 0) throw std::runtime_error(series.name + " failed");
  line.resize(static_cast<std::size_t>(size));
  return line;
}

}  // namespace
}  // namespace perilink::verification

bool perilink::verification::run_program(const std::vector<std::string>& arguments) {
  if (!arguments.empty() && arguments[0] == "events") {
    const auto number = [&](std::size_t k, int otherwise) {
      return arguments.size() > k ? std::stoi(arguments[k]) : otherwise;
    };
    const bool direct = arguments.size() > 3 && arguments[3] == "direct";
    return compare_events(number(1, 14), number(2, 500), direct,
                          arguments.size() > 4 ? arguments[4] : "");
  }
  const bool quick = !arguments.empty() && arguments[0] == "quick";
  std::string table =
      "body,horizon_ratio,unknowns,solver,iterations,set_up,calibration,preparation,solution,"
      "residual,peak_gigabytes\n";
  fmt::print("{}", table);
  const auto add = [&](const Series& series, int columns, LinearSolver solver) {
    const std::string line = measure_apart(series, columns, solver);
    fmt::print("{}", line);
    std::fflush(stdout);
    table += line;
    return line;
  };
  bool good = true;
  for (const Series& series : all_series) {
    std::vector<int> iterations;
    for (const int columns : series.columns) {
      if (quick && columns > (series.space ? 38 : 260)) continue;
      if (columns <= series.largest_factor && !quick) add(series, columns, LinearSolver::direct);
      const std::string line = add(series, columns, LinearSolver::iterative);
      std::size_t comma = 0;
      for (int k = 0; k < 4; ++k) comma = line.find(',', comma) + 1;
      iterations.push_back(std::stoi(line.substr(comma)));
    }
    good = good && iterations.back() <= 1.15 * iterations.front();
  }
  if (!quick) write_result(PERILINK_STUDY_DIR, table);
  return good;
}
