#pragma once

#include <cmath>
#include <string>

#include "io/fields/vtu.hpp"

namespace perilink::test {

/// Invented field file of a plate of nx × ny particles (× nz in three dimensions). An open crack
/// runs from below to half its height in the middle. Hexagonal plates have shifted rows.
struct CrackedPlate {
  int nx = 25;
  int ny = 8;
  int nz = 1;
  bool hexagonal = false;
  double spacing = 2.0;
};

/// \param broken_at  number of the break of a bond
inline void append_line(VtuGrid& grid, int i, int j, double element, double broken_at = 0.0) {
  grid.types.push_back(VtuCell::line);
  grid.connectivity.insert(grid.connectivity.end(), {i, j});
  grid.offsets.push_back(static_cast<int>(grid.connectivity.size()));
  grid.cell_data[0].values.push_back(element);
  grid.cell_data[1].values.push_back(broken_at);
}

inline void append_particles(VtuGrid& grid, const CrackedPlate& plate) {
  const double row = plate.hexagonal ? std::sqrt(0.75) : 1.0;
  const double middle = 0.5 * plate.spacing * plate.nx;
  const double tip = 0.5 * row * plate.spacing * plate.ny;
  for (int k = 0; k < plate.nz; ++k) {
    for (int j = 0; j < plate.ny; ++j) {
      for (int i = 0; i < plate.nx; ++i) {
        const double x = plate.spacing * (i + (plate.hexagonal && j % 2 == 1 ? 0.5 : 0.0));
        const double y = plate.spacing * row * j;
        const double opening = y < tip ? 1e-4 * (tip - y) : 0.0;
        const bool at_crack = std::abs(x - middle) < plate.spacing && y < tip;
        grid.points.insert(grid.points.end(), {x, y, plate.spacing * k});
        grid.point_data[0].values.insert(grid.point_data[0].values.end(),
                                         {x < middle ? -opening : opening, 0.0, 0.0});
        grid.point_data[1].values.push_back(at_crack ? 0.4 : 0.0);
        grid.point_data[2].values.push_back(0.0);
      }
    }
  }
}

/// Appends a row of particles of `kind` (1 ghost, 2 rebar) at height y.
inline void append_row(VtuGrid& grid, const CrackedPlate& plate, double y, double kind) {
  for (int i = 0; i < plate.nx; ++i) {
    grid.points.insert(grid.points.end(), {plate.spacing * i, y, 0.0});
    grid.point_data[0].values.insert(grid.point_data[0].values.end(), {0.0, 0.0, 0.0});
    grid.point_data[1].values.push_back(0.0);
    grid.point_data[2].values.push_back(kind);
  }
}

inline VtuGrid make_cracked_field(const CrackedPlate& plate, bool ghosts_and_bar) {
  VtuGrid grid;
  grid.point_data = {{"displacement", 3, {}}, {"damage", 1, {}}, {"kind", 1, {}}};
  grid.cell_data = {{"element", 1, {}}, {"broken_at", 1, {}}};
  append_particles(grid, plate);
  const int bar = static_cast<int>(grid.points.size() / 3) + plate.nx;
  if (ghosts_and_bar) {
    append_row(grid, plate, -plate.spacing, 1.0);
    append_row(grid, plate, 1.5 * plate.spacing, 2.0);
  }
  const int size = static_cast<int>(grid.points.size() / 3);
  for (int i = 0; i < size; ++i) {
    grid.types.push_back(VtuCell::vertex);
    grid.connectivity.push_back(i);
    grid.offsets.push_back(i + 1);
    grid.cell_data[0].values.push_back(0.0);
    grid.cell_data[1].values.push_back(0.0);
  }
  int broken = 0;
  for (int k = 0; k < plate.nz; ++k) {
    for (int j = 0; j < plate.ny / 2; ++j, ++broken) {
      const int left = (k * plate.ny + j) * plate.nx + (plate.nx - 1) / 2;
      append_line(grid, left, left + 1, 1.0, broken + 1.0);
    }
  }
  for (int i = 0; ghosts_and_bar && i + 1 < plate.nx; ++i) {
    append_line(grid, bar + i, bar + i + 1, 2.0);
  }
  grid.field_data = {{"step", broken + 1.0},
                     {"broken_bonds", static_cast<double>(broken)},
                     {"load_factor", 0.4127},
                     {"load", 12.345},
                     {"dimension", plate.nz > 1 ? 3.0 : 2.0},
                     {"spacing", plate.spacing}};
  return grid;
}

}  // namespace perilink::test
