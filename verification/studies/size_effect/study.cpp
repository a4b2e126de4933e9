// The elastic size effect of Gerstle, Sau & Aguilera (2007), section 5, from this program's bonds.
//
//   size_effect [DIRECTORY]    writes three tables and two pictures there, default: where it is run
//
// Exit status 1 when something misses its acceptance.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>

#include "draw.hpp"
#include "io/text/csv.hpp"
#include "problems/program.hpp"
#include "size_effect.hpp"

namespace perilink::verification {
namespace {

struct Series {
  Problem problem;
  std::vector<double> poissons_ratios;
  std::vector<int> horizon_ratios;
};

/// Depths 0, 0.05 ... 1 where the lattice has them.
std::vector<int> rows_of(int horizon_ratio) {
  std::vector<int> rows;
  const int step = std::max(1, horizon_ratio / 20);
  for (int row = 0; row <= horizon_ratio; row += step) rows.push_back(row);
  return rows;
}

double dimension_as_number(Problem problem) { return problem == Problem::plane_stress ? 2.0 : 3.0; }

/// \return the finest families; appends to the table of largest differences
std::vector<NeighbourhoodRow> run_series(const Series& series, CsvWriter& table, bool& good) {
  std::vector<NeighbourhoodRow> rows;
  for (const int ratio : series.horizon_ratios) {
    rows = compare_neighbourhoods({series.problem, ratio, rows_of(ratio), series.poissons_ratios});
    const auto largest = largest_differences(rows);
    const double dimension = dimension_as_number(series.problem);
    table.write_row(
        {dimension, static_cast<double>(ratio), largest[0], largest[1], largest[2], largest[3]});
    fmt::print(
        "{:.0f}D, horizon {:3d} spacings: E1/E {:.1e}  E2/E {:.1e}  nu12 {:.1e}  nu2 {:.1e}\n",
        dimension, ratio, largest[0], largest[1], largest[2], largest[3]);
  }
  const auto finest = largest_differences(rows);
  good = good && *std::max_element(finest.begin(), finest.end()) <= acceptance;
  return rows;
}

void write_neighbourhoods(const std::vector<NeighbourhoodRow>& rows, double dimension,
                          CsvWriter& file) {
  const auto round = [](double value) { return std::round(1e6 * value) / 1e6; };
  for (const NeighbourhoodRow& row : rows) {
    const LayerModuli &a = row.found, &b = row.exact;
    file.write_row({dimension, row.poissons_ratio, round(row.depth), round(a.e1), round(a.e2),
                    round(a.nu12), round(a.nu2), round(b.e1), round(b.e2), round(b.nu12),
                    round(b.nu2)});
  }
}

bool run_neighbourhoods(const std::string& directory) {
  bool good = true;
  CsvWriter table(directory + "/result.csv", {"dimension", "horizon_ratio", "e1_error", "e2_error",
                                              "nu12_error", "nu2_error"});
  CsvWriter neighbourhoods(directory + "/families.csv",
                           {"dimension", "poissons_ratio", "depth", "e1", "e2", "nu12", "nu2",
                            "e1_exact", "e2_exact", "nu12_exact", "nu2_exact"});
  const Series space{Problem::three_dimensional, {0.0, 0.1, 0.2, 0.22, 0.25}, {5, 10, 20, 40, 60}};
  const Series plane{
      Problem::plane_stress, {0.0, 0.1, 0.2, 0.22, 0.25, 0.3}, {5, 10, 20, 40, 80, 160, 320}};
  for (const Series& series : {space, plane}) {
    const auto rows = run_series(series, table, good);
    write_neighbourhoods(rows, dimension_as_number(series.problem), neighbourhoods);
    if (series.problem == Problem::three_dimensional) {
      draw_neighbourhoods(rows).save(directory + "/families.svg");
    }
  }
  return good;
}

bool run_bars(const std::string& directory) {
  CsvWriter table(directory + "/bars.csv", {"width", "horizon_ratio", "uncorrected", "families",
                                            "closed_form", "calibrated"});
  bool good = true;
  std::vector<BarRow> drawn;
  for (const int ratio : {3, 6, 12}) {
    for (const int width : {1, 2, 3, 4, 6}) {
      if (ratio == 12 && width == 6) continue;  // gigabytes
      const BarRow row = compare_bar(width, ratio, 0.2, ratio == 3);
      fmt::print(
          "width {}, horizon {:2d} spacings: {:.4f}, bound {:.4f}, closed form {:.4f}, "
          "calibrated {:.10f}\n",
          width, ratio, row.uncorrected, row.neighbourhoods, row.exact, row.calibrated);
      std::fflush(stdout);
      table.write_row({static_cast<double>(width), static_cast<double>(ratio), row.uncorrected,
                       row.neighbourhoods, row.exact, row.calibrated});
      const double relaxed = 1.0 - row.uncorrected / row.neighbourhoods;
      good = good && relaxed > 0.0 && relaxed < largest_relaxation;
      if (ratio == 3) good = good && std::abs(row.calibrated - 1.0) < calibrated_acceptance;
      if (ratio == 12) good = good && std::abs(row.uncorrected - row.exact) < bar_acceptance;
      if (ratio == 3) drawn.push_back(row);
    }
  }
  draw_bars(drawn).save(directory + "/bars.svg");
  return good;
}

}  // namespace
}  // namespace perilink::verification

bool perilink::verification::run_program(const std::vector<std::string>& arguments) {
  const std::string directory = arguments.empty() ? "." : arguments[0];
  const bool neighbourhoods = run_neighbourhoods(directory);
  const bool bars = run_bars(directory);
  return neighbourhoods && bars;
}
