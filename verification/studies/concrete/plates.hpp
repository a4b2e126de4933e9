#pragma once

#include <string>
#include <vector>

/// \file
/// Plates of concrete that are loaded along both axes by pressure or pull on their sides, so that
/// the sides are free to move along themselves.

namespace perilink::verification {

/// How a plate is made up and loaded.
struct Plate {
  std::string body;            ///< "lattice", "mesh" or "slab", 67.7 mm thick and in space
  double along_x, along_y;     ///< tractions on the sides at load factor 1 [N/mm^2]
  bool shear_softens = false;  ///< rule B of the law; else rule A
};

/// Its case.
std::string plate_case(const Plate& plate);

/// What a run told.
struct PlateResult {
  double strength = 0.0;  ///< largest load factor [N/mm^2 of what has the traction one]
  double strain = 0.0;    ///< there, work-conjugate to it [-]
  double cell_tension = 0.0, cell_compression = 0.0;  ///< strengths of the cell of the bonds
  double energy_error = 0.0;
  int events = 0;
  long broken = 0;
  std::string termination;
  std::vector<std::pair<double, double>> curve;  ///< strain and load factor, a point in every few
};
PlateResult load_plate(const Plate& plate);

}  // namespace perilink::verification
