// How cracks grow with each option for surfaces: peak load, energy per area, path, stray breaks.
//
//   cracks [DIRECTORY]    writes result.csv and five pictures there, default: where it is run
//
// Exit status 1 when something misses its acceptance. About three minutes.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>

#include "app/plot/plot_fields.hpp"
#include "cracks.hpp"
#include "draw.hpp"
#include "problems/program.hpp"
#include "problems/result.hpp"

namespace perilink::verification {
namespace {

constexpr const char* heading =
    "specimen,surface,spacing,horizon_ratio,broken_bonds,ending,first_load,peak_load,smooth_peak,"
    "reference_load,path_start,path_end,crack_extent,crack_length,dissipated_over_GF,growth_over_"
    "GF,"
    "released_over_GF,plane_crack_over_GF,stray,stray_at_notch,farthest_in_horizons,energy_error\n";

std::string table_row(const CrackRun& run) {
  const StepRecord& last = run.result.last;
  const Specimen& specimen = run.specimen;
  const double e = run.path.energy, horizon = specimen.horizon_ratio * specimen.spacing;
  return fmt::format(
      "{},{},{},{},{},{},{:.5g},{:.5g},{:.5g},{},{:.2f},{:.2f},{:.2f},{:.2f},{:.3f},{:.3f},{:.3f},"
      "{:.3f},{},{},{:.2f},{:.1e}\n",
      specimen.name, surface_word(specimen.surface), specimen.spacing, specimen.horizon_ratio,
      last.broken_bonds, to_string(run.result.termination), run.first_load, run.result.peak_load,
      run.smooth_peak, run.reference_load ? fmt::format("{:.5g}", *run.reference_load) : "",
      run.path.rows.front().across, run.path.rows.back().across, run.path.extent, run.path.length,
      last.dissipated_energy / e, run.growth_ratio, last.released_energy / e, run.plane_ratio,
      run.stray.elsewhere, run.stray.at_notch, run.stray.farthest / horizon,
      run.result.energy_error);
}

/// What the README asks of calibrated bonds.
bool is_accepted(const CrackRun& run) {
  if (run.specimen.surface != Surface::calibrated) return true;
  bool good = run.stray.elsewhere == 0 && run.result.energy_error < 1e-9;
  if (run.specimen.shape == Shape::block) {
    return good && std::abs(run.first_load / *run.reference_load - 1.0) < 0.005;
  }
  // The crack's length is uncertain by a spacing.
  const double released = run.result.last.released_energy / run.path.energy;
  return good &&
         std::abs(released / run.plane_ratio - 1.0) < run.specimen.spacing / run.path.length;
}

class Table {
 public:
  Table() { add(heading); }

  void add(const std::string& line) {
    fmt::print("{}", line);
    std::fflush(stdout);
    text += line;
  }

  CrackRun run(Shape shape, double spacing, Surface surface, int horizon_ratio) {
    CrackRun run = run_specimen(make_specimen(shape, spacing, surface, horizon_ratio), 1);
    add(table_row(run));
    good = good && is_accepted(run);
    return run;
  }

  std::string text;
  bool good = true;
};

void draw_body(const CrackRun& run, const std::string& path) {
  const bool block = run.specimen.shape == Shape::block;
  const PlotLabels labels = {
      fmt::format("{}, {} bonds", run.specimen.name, surface_word(run.specimen.surface)),
      block ? "kip" : "N", block ? "in" : "mm"};
  const StepRecord& last = run.result.last;
  draw_fields(run.body, {last.broken_bonds, last.load_factor, last.load}, labels, 0.0).save(path);
}

}  // namespace
}  // namespace perilink::verification

bool perilink::verification::run_program(const std::vector<std::string>& arguments) {
  const std::string directory = arguments.empty() ? "." : arguments[0];
  Table table;
  std::vector<CrackRun> runs;
  for (const Shape shape : {Shape::block, Shape::notched_beam, Shape::cracked_beam}) {
    for (const Surface surface : {Surface::calibrated, Surface::none, Surface::ghost}) {
      for (const int refinement : {1, 2, 4}) {
        const double coarsest = shape == Shape::block ? 5.0 : 4.0;
        runs.push_back(table.run(shape, coarsest / refinement, surface, 3));
        if (surface != Surface::calibrated || refinement != 2) continue;
        std::string name = runs.back().specimen.name;
        std::replace(name.begin(), name.end(), ' ', '_');
        draw_body(runs.back(), fmt::format("{}/{}.svg", directory, name));
      }
    }
  }
  for (const int horizon_ratio : {2, 4, 5}) {
    table.run(Shape::cracked_beam, 2.0, Surface::calibrated, horizon_ratio);
  }
  draw_paths(runs).save(directory + "/paths.svg");
  draw_energies(runs).save(directory + "/energies.svg");
  write_result(directory, table.text);
  return table.good;
}
