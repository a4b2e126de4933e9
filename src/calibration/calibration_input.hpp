#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "base/types.hpp"
#include "calibration/bond_equations.hpp"
#include "calibration/bond_orbits.hpp"
#include "discretization/bonds.hpp"
#include "discretization/particles.hpp"

namespace perilink {

/// What is calibrated.
struct CalibrationInput {
  const Particles& particles;            ///< solid ones
  const Bonds& bonds;                    ///< between them
  std::vector<LameConstants> materials;  ///< by Particles::material and Facets
  /// Bonds whose stiffness may change, the others are right as they are (interior of a lattice).
  /// Empty: all may, and the energies of dilatation are made right as well, softly (irregular
  /// clouds).
  std::vector<std::uint8_t> free;
  bool all_free() const { return free.empty(); }
  /// The box that the particles fill with one lattice. Where the material is the same all over,
  /// bonds that lie alike are made alike.
  std::optional<LatticeBox> box = std::nullopt;
  /// Step along each axis of a lattice in space that may fill something else: bonds with the same
  /// surroundings are made alike where much repeats [length].
  std::optional<Vector3> step = std::nullopt;
  bool only_alike = false;  ///< nothing is changed where they have no solution
  /// In the plane: where particles have no solution, single equations are given up and all others
  /// hold, as in irregular clouds, in place of least squares.
  bool give_up = false;
};

/// Told before every search for stiffnesses: its number, from 1, and the largest force or moment
/// out of balance that the last one left (see CalibrationReport).
using CalibrationObserver = std::function<void(int search, double unbalanced)>;

struct CalibrationOptions {
  double least_weight = 0.02;     ///< relative to the start
  double tolerance = 1e-12;       ///< root mean square of the forces out of balance (see below)
  CalibrationObserver on_search;  ///< may be empty
};

/// What was reached. Forces out of balance are those on a particle at a uniform strain of one,
/// divided by 1/2 sum k xi^2 / (mean xi) of its bonds at the start: about the force on a face of
/// its cell.
struct CalibrationReport {
  Index free_bonds = 0;
  bool alike = false;            ///< bonds that lie alike were made alike
  double residual_before = 0.0;  ///< largest force out of balance at the start ...
  double residual_after = 0.0;   ///< ... and at the end
  double moment_after = 0.0;  ///< largest moment out of balance of bonds that carry moments, over
                              ///< 1/2 sum k xi^2
  double sum_after = 0.0;     ///< largest force or moment of each particle, summed
  Index worst_particle = no_index;
  /// Particles with a force or moment of more than 1e-7 out of balance at the end.
  Index unmet = 0;
  double smallest_weight = 1.0;  ///< axial stiffness, end over start
  double largest_weight = 1.0;
  Index at_least_weight = 0;  ///< number of bonds at the least weight
  Index dropped = 0;          ///< bonds that may carry nothing: their stiffness is zero
  int iterations = 0;         ///< conjugate gradients, in all
  double seconds = 0.0;       ///< wall time, with that of the families of a lattice
  double bytes = 0.0;         ///< memory with the network; expected ones only
};

}  // namespace perilink
