#pragma once

#include <span>
#include <string>
#include <vector>

#include "model/from_case/configure.hpp"

namespace perilink::verification {

/// Built-in structures under a uniform load, after Miranda, Williams & Orr.
enum class Structure {
  cantilever,
  clamped,  ///< beam that is built in at both ends
  plate,    ///< built in along three edges, the fourth one (largest y) free
};
std::string to_string(Structure structure);

/// How many cells a structure is wide. Loads act along -y on beams, along -z on the plate.
struct Sizes {
  int length = 0;       ///< along x
  int height = 0;       ///< along y
  int depth = 0;        ///< along z
  double cell = 0.025;  ///< [m]

  double x() const { return length * cell; }
  double y() const { return height * cell; }
  double z() const { return depth * cell; }
};
/// As many cells as the study has.
Sizes sizes_of(Structure structure);

inline constexpr double youngs_modulus = 20e9;  ///< [N/m^2]
inline constexpr double poissons_ratio = 0.25;
inline constexpr double body_force = 10e3 / (0.15 * 0.25);  ///< 10 kN/m on the beams [N/m^3]

/// A structure made of particles and something that joins them.
struct Specimen {
  Structure structure = Structure::cantilever;
  Sizes sizes;
  std::string joined;     ///< "calibrated", ..., "linear elements"; "fibres"
  bool in_cells = false;  ///< particles in the middle of their cells, not on the surface
  Model model;
};

/// \param joined  "none", "energy", "calibrated": bonds with that `surface`, horizon three cells;
/// "linear elements"; all have particles on the surface, and those of built-in faces are held.
/// "fibres": the particles of the paper, in the middle of cells, six more layers behind built-in
/// faces, all with the same volume and bonds k = c V^2 / xi, c = 12 E / (pi delta^4), horizon 5.4
/// cells, so many that the numbers of bonds are about those of the paper
Specimen make_specimen(Structure structure, const Sizes& sizes, const std::string& joined);

/// Young's modulus that a beam of fibres, built in at one end, shows when its other end is pulled:
/// what the paper scales their stiffness by (its section 8) [N/m^2].
double axial_modulus(const Specimen& specimen);

/// Deflection where the structure bends most [m]: mean over the section at the end or in the middle
/// of a beam, over the thickness in the middle of the free edge of the plate, there by a straight
/// line through the last two layers where particles are in cells.
double deflection(const Specimen& specimen, std::span<const double> displacement);

/// Mean deflections of the sections of a beam along x, each at its place [m].
struct Shape {
  std::vector<double> x, deflection;
};
Shape shape(const Specimen& specimen, std::span<const double> displacement);

/// Deflection of a beam after Bernoulli [m].
double bernoulli(Structure structure, const Sizes& sizes, double x);
/// The same with the shear deflection after Timoshenko, Cowper's (1966) coefficient
/// 10 (1 + nu) / (12 + 11 nu).
double timoshenko(Structure structure, const Sizes& sizes, double x);

}  // namespace perilink::verification
