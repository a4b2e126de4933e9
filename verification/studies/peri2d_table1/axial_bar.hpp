#pragma once

#include "discretization/lattices/lattice.hpp"

/// \file
/// The axial bar of Gerstle, Sau & Silling (2005), section 4, solved with the program's lattice,
/// bonds, micromodulus, assembly and factor.

namespace perilink::verification {

/// Grid of one row of Table 1. What the paper does not tell has the value that follows from its
/// text as default; README.md says how the other values were found.
struct BarGrid {
  Pattern pattern = Pattern::rectangular;
  int columns = 0;  ///< particles across the width of 100 in
  // Whether a row or column exactly on the edge of a region counts as inside.
  bool body_has_top_row = true;      ///< y = 250
  bool body_has_left_column = true;  ///< x = 0, every second row of the hexagonal pattern
  bool load_has_inner_row = true;    ///< y = 0, upper edge of the lower cap
  bool centre_row_above = false;     ///< strains are measured one row above the usual one
};

/// One row of Table 1: deviations from the theory of elasticity.
struct BarErrors {
  double strain_x = 0.0;        ///< [%]
  double strain_y = 0.0;        ///< [%]
  double poissons_ratio = 0.0;  ///< [%]
  double displacement = 0.0;    ///< 2 U / P with the energy of bonds between solid particles [%]
  double links = 0.0;           ///< bonds of the particle in the middle
  double whole_displacement = 0.0;  ///< 2 U / P with the energy of all bonds, not in the table [%]
};

BarErrors solve_bar(const BarGrid& grid);

}  // namespace perilink::verification
