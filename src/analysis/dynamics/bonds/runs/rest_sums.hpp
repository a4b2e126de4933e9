#pragma once

namespace perilink {

/// Sums over the particles of one or all blocks in an iteration of a dynamic relaxation.
struct RestSums {
  double push = 0.0, size = 0.0;      // squares r'M^-1 r and u'M u
  double residual = 0.0, held = 0.0;  // squares of residual forces, of loads and reactions
  // Over the motion d since the load step began or bonds broke: d'K d, d'M d, work of the loads.
  double stiffness = 0.0, mass = 0.0, work = 0.0;
  double last_stiffness = 0.0, last_mass = 0.0;  // over the last step
  double fractured = 0.0;                        // since the beginning

  void operator+=(const RestSums& other) {
    push += other.push;
    size += other.size;
    residual += other.residual;
    held += other.held;
    stiffness += other.stiffness;
    mass += other.mass;
    work += other.work;
    last_stiffness += other.last_stiffness;
    last_mass += other.last_mass;
    fractured += other.fractured;
  }
};

/// Next act of a dynamic relaxation after an iteration.
enum class AfterIteration {
  iterate,
  examine,        ///< the pieces of the body, then iterate
  end_load_step,  ///< the body is in equilibrium
  end_run
};

/// Decision after the forces of an iteration of a dynamic relaxation.
struct Decision {
  double keep = 1.0, lose = 1.0;  ///< damping: factors of velocities
  bool restart = true;            ///< the damping is measured from here
  AfterIteration then = AfterIteration::iterate;
  bool iterates() const {
    return then == AfterIteration::iterate || then == AfterIteration::examine;
  }
};

/// A residual that has grown by this factor since the first iteration has diverged.
inline constexpr double largest_growth = 1e12;

}  // namespace perilink
