// Prints Table 1 of Gerstle, Sau & Silling (2005) beside what this program finds.
//
//   peri2d_table1 [DIRECTORY]    writes result.csv and errors.svg there, default: where it is run
//
// Exit status 1 when an entry differs by more than the acceptance.

#include <fmt/format.h>

#include <cmath>
#include <string>

#include "draw_table.hpp"
#include "io/text/csv.hpp"
#include "problems/program.hpp"
#include "table1.hpp"

namespace perilink::verification {
namespace {

void print_entry(double found, double printed) {
  const std::string reference = std::isnan(printed) ? "–" : fmt::format("{:.2f}", printed);
  const std::string difference = std::isnan(printed) ? "" : fmt::format("{:+.3f}", found - printed);
  fmt::print("  {:8.3f} {:>7} {:>6}", found, reference, difference);
}

void print_table(const std::vector<TableRow>& rows) {
  fmt::print("Deviation from linear elasticity in percent: found, printed, difference\n\n");
  fmt::print("{:<11} {:>2}  {:<23}  {:<23}  {:<23}  {:<23}  {}\n", "pattern", "n", "strain x",
             "strain y", "Poisson's ratio", "displacement", "links");
  for (const TableRow& row : rows) {
    fmt::print("{:<11} {:>2}", row.grid.pattern == Pattern::hexagonal ? "hexagonal" : "rectangular",
               row.grid.columns);
    print_entry(row.found.strain_x, row.printed.strain_x);
    print_entry(row.found.strain_y, row.printed.strain_y);
    print_entry(row.found.poissons_ratio, row.printed.poissons_ratio);
    print_entry(row.found.displacement, row.printed.displacement);
    fmt::print("  {} {}\n", row.found.links, row.printed.links);
  }
}

void write_result(const std::vector<TableRow>& rows, const std::string& path) {
  CsvWriter file(
      path, {"hexagonal", "columns", "strain_x_error", "strain_y_error", "poissons_ratio_error",
             "displacement_error", "links", "displacement_error_all_bonds"});
  const auto round = [](double value) { return std::round(1e4 * value) / 1e4; };
  for (const TableRow& row : rows) {
    const BarErrors& found = row.found;
    file.write_row({row.grid.pattern == Pattern::hexagonal ? 1.0 : 0.0,
                    static_cast<double>(row.grid.columns), round(found.strain_x),
                    round(found.strain_y), round(found.poissons_ratio), round(found.displacement),
                    found.links, round(found.whole_displacement)});
  }
  file.flush();
}

/// \return whether every entry is within the acceptance
bool judge(const std::vector<TableRow>& rows) {
  int entries = 0, reproduced = 0, links = 0;
  double worst = 0.0;
  for (const TableRow& row : rows) {
    links += row.found.links == row.printed.links ? 1 : 0;
    for (const double deviation : deviations(row)) {
      if (std::isnan(deviation)) continue;
      ++entries;
      reproduced += std::abs(deviation) <= acceptance ? 1 : 0;
      worst = std::max(worst, std::abs(deviation));
    }
  }
  fmt::print(
      "\n{} of {} entries within {} points, the worst differs by {:.4f}; "
      "links per particle equal in {} of {} rows\n",
      reproduced, entries, acceptance, worst, links, rows.size());
  return reproduced == entries && links == static_cast<int>(rows.size());
}

}  // namespace
}  // namespace perilink::verification

bool perilink::verification::run_program(const std::vector<std::string>& arguments) {
  const std::string directory = arguments.empty() ? "." : arguments[0];
  const auto rows = reproduce_table(PERILINK_STUDY_DIR "/reference.csv");
  print_table(rows);
  write_result(rows, directory + "/result.csv");
  draw_table(rows).save(directory + "/errors.svg");
  return judge(rows);
}
