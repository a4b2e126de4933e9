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

/// Body to calibrate.
struct CalibrationInput {
  const Particles& particles;            ///< solid particles
  const Bonds& bonds;                    ///< bonds between them
  std::vector<LameConstants> materials;  ///< by Particles::material and Facets
  /// Bonds whose stiffness may change; other bonds (interior of a lattice) stay. Empty: all may
  /// change, and soft equations correct the energies of dilatation (unstructured particle sets).
  std::vector<std::uint8_t> free;
  bool all_free() const { return free.empty(); }
  /// Box that the particles fill with one lattice. With one material, symmetry-equivalent bonds get
  /// equal stiffness.
  std::optional<LatticeBox> box = std::nullopt;
  /// Step along each axis of a lattice in space of any shape [length]. Bonds with equal local
  /// environments get equal stiffness where the classes are few.
  std::optional<Vector3> step = std::nullopt;
  bool only_alike = false;  ///< stop where the symmetry-reduced equations have no solution
  /// In the plane: relaxes single infeasible equations by an exact penalty, as in unstructured
  /// particle sets, in place of least squares.
  bool give_up = false;
};

/// Called before every solution, with its number from 1 and the largest unbalanced force or moment
/// of the previous one (see CalibrationReport).
using CalibrationObserver = std::function<void(int search, double unbalanced)>;

class CalibrationStore;

/// Observer and store of the calibration of a model.
struct CalibrationCalls {
  CalibrationObserver on_search = {};  ///< may be empty
  CalibrationStore* store = nullptr;   ///< see calibrate_once()
};

struct CalibrationOptions {
  double least_weight = 0.02;     ///< relative to the start
  double tolerance = 1e-12;       ///< root mean square of the unbalanced forces (see below)
  CalibrationObserver on_search;  ///< may be empty
};

/// Result of a calibration. Unbalanced forces are forces on a particle at a uniform strain of one,
/// divided by 1/2 sum k xi^2 / (mean xi) of its bonds at the start. This divisor is about the force
/// on a face of its cell.
struct CalibrationReport {
  Index free_bonds = 0;
  bool alike = false;            ///< whether the problem was symmetry-reduced
  bool in_parts = false;         ///< parts of unlike stiffness one by one
  double residual_before = 0.0;  ///< largest unbalanced force at the start ...
  double residual_after = 0.0;   ///< ... and at the end
  double moment_after = 0.0;     ///< largest unbalanced moment over 1/2 sum k xi^2
  double sum_after = 0.0;        ///< largest force or moment of each particle, summed
  Index worst_particle = no_index;
  /// Number of particles with an unbalanced force or moment above 1e-7 at the end.
  Index unmet = 0;
  double smallest_weight = 1.0;  ///< axial stiffness, end over start
  double largest_weight = 1.0;
  Index at_least_weight = 0;  ///< number of bonds at the least weight
  Index dropped = 0;          ///< number of dropped bonds, whose stiffness is zero
  int iterations = 0;         ///< total of conjugate-gradient iterations
  double seconds = 0.0;       ///< wall time, with the interior neighbourhoods of a lattice
  double bytes = 0.0;         ///< memory with the network; only in estimates

  template <class Archive>
  void serialize(Archive& archive) {
    archive(free_bonds, alike, residual_before, residual_after, moment_after, sum_after,
            worst_particle, unmet, smallest_weight, largest_weight, at_least_weight, dropped,
            iterations, seconds, bytes);
  }
};

}  // namespace perilink
