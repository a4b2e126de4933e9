#pragma once

#include <array>
#include <string>
#include <vector>

#include "axial_bar.hpp"

namespace perilink::verification {

/// A row of Table 1 of Gerstle, Sau & Silling (2005) as printed and as this program finds it. Not a
/// number where the paper prints none.
struct TableRow {
  BarGrid grid;
  BarErrors printed;
  BarErrors found;
};

/// Largest difference of an entry that counts as reproduced; the paper prints two digits after the
/// point [percentage points].
inline constexpr double acceptance = 0.02;

/// Differences found - printed of the four entries in percent: strain x, strain y, Poisson's ratio,
/// displacement [percentage points].
std::array<double, 4> deviations(const TableRow& row);

/// Solves the bar of every row of the printed table.
/// \throws FileError where `reference` cannot be read
std::vector<TableRow> reproduce_table(const std::string& reference);

}  // namespace perilink::verification
