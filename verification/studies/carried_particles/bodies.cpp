#include "bodies.hpp"

#include <fmt/format.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <stdexcept>

#include "model/from_case/configure.hpp"

namespace perilink::verification {
namespace {

double processor_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

/// Follows the crack.
class Watch final : public StepObserver {
 public:
  explicit Watch(const Network& network, Run& run) : network_(network), run_(run) {}

  void on_step(const StepRecord& row, StateSource&) override {
    ++run_.events;
    if (row.element == no_index) return;
    const auto a = network_.particles.position(network_.bonds.first[row.element]);
    const auto b = network_.particles.position(network_.bonds.second[row.element]);
    run_.crack += 0.5 * (a[0] + b[0]);
    run_.height = std::max(run_.height, 0.5 * (a[1] + b[1]));
  }

 private:
  const Network& network_;
  Run& run_;
};

Run run_here(const std::string& text) {
  Run run;
  const CaseFile input = parse_case(text, "beam.toml");
  const Model model = build_model(input);
  run.set_up = processor_seconds();
  Watch watch(model.network, run);
  const DamageResult result = run_damage_analysis(model, damage_options(input, 1), watch);
  run.seconds = processor_seconds();
  run.unknowns = model.unknowns.count;
  run.unknowns_at_end = result.unknowns;
  run.conversions = result.conversions;
  run.peak = std::abs(result.peak_load);
  run.smoothed_peak = std::abs(result.smoothed_peak_load.value_or(result.peak_load));
  run.dissipated = result.last.dissipated_energy;
  run.freed = result.last.constraint_energy;
  run.crack /= run.events;
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  run.gigabytes = static_cast<double>(usage.ru_maxrss) / 1e6;
  return run;
}

std::string region(const std::string& name, double x0, double x1, double y0, double y1,
                   bool in_space = false) {
  return fmt::format("[[regions]]\nname = \"{}\"\nx = [{}, {}]\ny = [{}, {}]\n{}", name, x0, x1, y0,
                     y1, in_space ? "z = [0, 50]\n" : "");
}

std::string material(const std::string& regions, const std::string& fracture_energy) {
  return fmt::format(
      "[[materials]]\nregions = [{}]\nyoungs_modulus = 30000.0\nfracture_energy = {}\n", regions,
      fracture_energy);
}

std::string support(const std::string& region, const std::string& axes) {
  return fmt::format("[[supports]]\nregion = \"{}\"\nfix = [{}]\n", region, axes);
}

std::string load(const std::string& force) {
  return fmt::format("[[loads]]\nregion = \"load\"\nforce = [{}]\n", force);
}

constexpr const char* unbreakable = "\"infinite\"";

std::string beam(bool in_space, double spacing) {
  const auto box = [&](const std::string& name, double x0, double x1, double y0, double y1) {
    return region(name, x0, x1, y0, y1, in_space);
  };
  const double x = 200.0 + 0.5 * spacing;
  const std::string crack =
      in_space ? fmt::format(
                     "corners = [[{0}, -1, -1], [{0}, 30, -1], [{0}, 30, 51], [{0}, -1, "
                     "51]]\n",
                     x)
               : fmt::format("points = [[{0}, -1], [{0}, 30]]\n", x);
  return box("beam", 0, 400, 0, 100) + box("left part", 0, 140, 0, 100) +
         box("right part", 260, 400, 0, 100) + box("top patch", 140, 260, 85, 100) +
         box("left support", 15, 25, 0, 0) + box("right support", 375, 385, 0, 0) +
         box("load", 190, 210, 100, 100) + material("\"beam\"", "0.1") +
         material("\"left part\", \"right part\", \"top patch\"", unbreakable) + "[[cracks]]\n" +
         crack + support("left support", in_space ? "\"x\", \"y\", \"z\"" : "\"x\", \"y\"") +
         support("right support", "\"y\"") + load(in_space ? "0, -1000, 0" : "0, -1000");
}

std::string panel() {
  return region("leg", 0, 250, 0, 500) + region("arm", 250, 500, 250, 500) +
         region("foot", 0, 250, 0, 60) + region("tip", 430, 500, 250, 500) +
         region("clamp", 0, 250, 0, 0) + region("load", 460, 480, 250, 250) +
         material("\"leg\", \"arm\"", "0.1") + material("\"foot\", \"tip\"", unbreakable) +
         support("clamp", "\"x\", \"y\"") + load("0, 1000");
}

std::string block() {
  return region("specimen", 0, 100, 0, 200) + region("lower cap", 0, 100, -50, 0) +
         region("upper cap", 0, 100, 200, 250) + region("weak place", 0, 10, 95, 105) +
         region("bottom", 0, 100, -50, -50) + region("middle", 50, 50, -50, -50) +
         region("load", 0, 100, 250, 250) + material("\"specimen\"", "0.1") +
         material("\"lower cap\", \"upper cap\"", unbreakable) +
         material("\"weak place\"", "0.07") + support("bottom", "\"y\"") +
         support("middle", "\"x\"") + load("0, 1000");
}

}  // namespace

std::string case_of(Scene scene, double spacing, const std::string& elements) {
  const bool in_space = scene == Scene::prism;
  const std::string body =
      fmt::format("[body]\nproblem = \"{}\"\nspacing = {}\nhorizon_ratio = {}\n{}",
                  in_space ? "three_dimensional" : "plane_stress", spacing, in_space ? 2 : 3,
                  in_space ? "pattern = \"cubic\"\n" : "thickness = 50.0\n");
  const std::string what = scene == Scene::panel   ? panel()
                           : scene == Scene::block ? block()
                                                   : beam(in_space, spacing);
  const char* stop = in_space ? "broken_bonds = 600\n" : "load_fraction = 0.3\n";
  return body + what + "[stop]\n" + stop + elements;
}

Run measure(const std::string& text) {
  int ends[2];
  if (pipe(ends) != 0) throw std::runtime_error("no pipe");
  const pid_t child = fork();
  if (child == 0) {
    Run run;
    int status = 0;
    try {
      run = run_here(text);
    } catch (const std::exception& error) {
      fmt::print(stderr, "{}\n", error.what());
      status = 1;
    }
    if (write(ends[1], &run, sizeof run) != sizeof run) status = 1;
    _exit(status);
  }
  close(ends[1]);
  Run run;
  const bool whole = child > 0 && read(ends[0], &run, sizeof run) == sizeof run;
  close(ends[0]);
  int status = 1;
  waitpid(child, &status, 0);
  if (!whole || status != 0) throw std::runtime_error("the run failed");
  return run;
}

}  // namespace perilink::verification
