#pragma once

#include <vector>

#include "network/loaded_network.hpp"

namespace perilink {

/// What constant loads add to a product that goes with the square of the load factor where all
/// loads grow: with u = u_c + lambda u_p it is `square` lambda^2 + linear lambda + constant.
struct Beside {
  double linear = 0.0, constant = 0.0;
  double at(double load_factor) const { return linear * load_factor + constant; }
  void operator+=(const Beside& other) {
    linear += other.linear;
    constant += other.constant;
  }
};

/// Work products of constant loads f_c, d_c, their displacements u_c and forces R_c of what drives
/// the body, and those of loads f_p, d_p that grow, at load factor 1 [force length].
struct ConstantWork {
  double forces = 0.0;            ///< f_c'u_c
  double forces_on_motion = 0.0;  ///< f_c'u_p
  double supports = 0.0;          ///< R_c'd_c
  double growing_forces = 0.0;    ///< f_p'u_c
  double growing_supports = 0.0;  ///< R_c'd_p
  double forces_on_clamps = 0.0;  ///< f_c'd_p: what of that f_c does, and no grip
};

/// Growth of f'u - R'd by constant loads beside that of the loads that grow. By Betti's theorem
/// both products of the two fields are twice f_p'u_c - R_c'd_p.
inline Beside permanent_growth(const ConstantWork& before, const ConstantWork& after) {
  const auto mixed = [](const ConstantWork& work) {
    return 2.0 * (work.growing_forces - work.growing_supports);
  };
  return {mixed(after) - mixed(before),
          (after.forces - after.supports) - (before.forces - before.supports)};
}

/// Loads and prescribed motions that stay while others grow, and the displacements that they alone
/// cause in the body as it stands. All displacements are the sum of these and of load factor times
/// those by the loads that grow.
struct ConstantField {
  Unknowns unknowns;  ///< those of the body, with the motions that stay prescribed
  Loads loads;
  double load_factor = 0.0;  ///< present one of the loads that grow

  // Kept by Equilibrium.
  std::vector<double> solution;           ///< per unknown
  std::vector<double> displacement;       ///< shape (particles, width)
  std::vector<double> ground_load;        ///< that of ground springs, per unknown; empty: none
  std::vector<std::size_t> driven_slots;  ///< whose motion is prescribed to stay or grow
  std::vector<Index> driven_elements;     ///< that end there
  double load_norm = 0.0;
  double largest_motion = 0.0;  ///< by `displacement`, where conjugate gradients leave errors
  bool rests = true;            ///< there are no constant loads, and nothing moves
};

}  // namespace perilink
