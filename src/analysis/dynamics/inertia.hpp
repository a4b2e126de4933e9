#pragma once

#include <span>
#include <vector>

#include "material/mass_scaling.hpp"
#include "material/strain.hpp"
#include "network/network.hpp"

namespace perilink {

/// Lumped inertia of the particles of a network.
struct Inertia {
  /// Masses and, where bonds carry moments, moments of inertia, shape (particles, width) [mass,
  /// mass length^2].
  std::vector<double> mass;
  /// Upper bound of the circular frequencies of the body [1/time]. Breaking bonds only lower them.
  double frequency_bound = 0.0;

  /// Returns the time step below which the motion without damping is stable [time].
  double critical_time_step() const { return 2.0 / frequency_bound; }
};

/// Returns lumped masses. Bonds between points determine no rotational inertia: rotations get the
/// inertia with which they vibrate as fast as the displacements. Particles without a material
/// (bars, ghosts) get the smallest mass with which they vibrate no faster than the fastest solid
/// particle.
///
/// The bound of the frequency: a mode of a bond of stiffness k deforms by b_i.q_i + b_j.q_j, and k
/// (b_i.q_i + b_j.q_j)^2 <= k (p_i + p_j) ((b_i.q_i)^2 / p_i + (b_j.q_j)^2 / p_j). Let p_i be the
/// largest eigenvalue of the own stiffness sum k b_i b_i' of particle i against its mass. The sum
/// of the right sides is then at most max (p_i + p_j) times the mass form. Hence omega^2 <= max
/// over bonds of p_i + p_j.
///
/// With Green strains the tangent of a bond grows with its stretch. The bound is then that of bonds
/// about to break, to first order in their stretch, at any rotation. Unbreakable bonds count
/// unstretched; a stretch s of these bonds lowers the critical step by the fraction 3 s / 2.
/// \param density  by material [mass/length^3], positive
/// \throws std::invalid_argument where a density is missing or not positive
Inertia lumped_inertia(const Network& network, std::span<const double> density,
                       MassScaling scaling = MassScaling::none, Strain strain = Strain::small);

}  // namespace perilink
