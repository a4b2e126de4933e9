#pragma once

#include <span>
#include <vector>

#include "analysis/quasistatic/equilibrium/body/damaged_body.hpp"
#include "assembly/internal_force.hpp"
#include "network/loaded_network.hpp"

namespace perilink {

/// Residual of a solution.
struct Residual {
  std::vector<double> forces;  ///< f - K u per unknown
  double size = 0.0;           ///< norm of `forces` over the norm of the load
  double energy = 0.0;         ///< sum of k e^2 / 2 of the solution [force length]
};

/// Displacements that one set of loads causes, and the loads of ground springs in this set.
struct Field {
  std::vector<double> values;        ///< solution per unknown
  std::vector<double> displacement;  ///< shape (particles, width)
  std::vector<double> ground_load;   ///< per unknown; empty: there are no ground springs
  /// Norm of load(). Where its forces cancel, as those of an even plastic strain do, norm of the
  /// forces of prescribed motions with their reactions.
  double load_norm = 0.0;
  /// Largest displacement, if errors of a motion spread to particles at rest; else 0 [length].
  double largest_motion = 0.0;

  void add(double factor, std::span<const double> motion);
  /// Loads a ground spring so that it rests at the present displacement.
  void add_ground_spring(Index unknown, double stiffness);
  /// Returns the forces on the unknowns, without those of prescribed motions.
  std::vector<double> forces(const Unknowns& unknowns, const Loads& loads) const;
  /// Returns all forces on the unknowns.
  std::vector<double> load(const DamagedBody& body, const Unknowns& unknowns, const Loads& loads,
                           double* norm = nullptr) const;
  /// Returns load() and sets its norm.
  std::vector<double> measure_load(const DamagedBody& body, const Unknowns& unknowns,
                                   const Loads& loads) {
    return load(body, unknowns, loads, &load_norm);
  }
  /// \param internal  receives the forces of the elements; its memory is reused
  Residual residual(const DamagedBody& body, const Unknowns& unknowns, const Loads& loads,
                    InternalForce& internal) const;
};

}  // namespace perilink
