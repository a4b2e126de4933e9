#pragma once

#include <span>
#include <vector>

#include "material/mass_scaling.hpp"
#include "material/strain.hpp"
#include "network/network.hpp"

namespace perilink {

/// What resists the acceleration of the particles of a network.
struct Inertia {
  /// Masses and, where bonds carry moments, moments of inertia behind them, shape (particles,
  /// width) [mass, mass length^2].
  std::vector<double> mass;
  /// No vibration of the body is faster [1/time]; breaking bonds only slow it down.
  double frequency_bound = 0.0;

  /// Time step below which the motion without damping is stable for certain [time].
  double critical_time_step() const { return 2.0 / frequency_bound; }
};

/// Lumped masses. Rotations, for which the bonds of a body without size leave nothing, get the
/// inertia with which they vibrate as fast as the displacements. Particles without a material (of
/// bars, ghosts) are as heavy as they must be not to vibrate faster than the fastest solid one.
///
/// The bound of the frequency: a mode of a bond of stiffness k deforms by b_i.q_i + b_j.q_j, and
/// k (b_i.q_i + b_j.q_j)^2 <= k (p_i + p_j) ((b_i.q_i)^2 / p_i + (b_j.q_j)^2 / p_j); with p_i the
/// largest eigenvalue of the own stiffness sum k b_i b_i' of particle i against its mass the sum of
/// the right sides is at most max (p_i + p_j) times the mass form, hence omega^2 <= max over bonds
/// of p_i + p_j.
///
/// With Green strains the tangent of a bond grows with its stretch. The bound then is that of all
/// bonds about to break, to the first order in their stretch, at any rotation. Unbreakable bonds
/// count as they are at rest; a stretch s of theirs lowers the critical step by the fraction
/// 3 s / 2.
/// \param density  by material [mass/length^3], positive
/// \throws std::invalid_argument where a density is missing or not positive
Inertia lumped_inertia(const Network& network, std::span<const double> density,
                       MassScaling scaling = MassScaling::none, Strain strain = Strain::small);

}  // namespace perilink
