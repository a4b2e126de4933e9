#pragma once

#include <algorithm>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "analysis/dynamics/explicit_run.hpp"
#include "analysis/quasistatic/load_curve.hpp"
#include "discretization/particles.hpp"
#include "io/case/case_file.hpp"
#include "network/network.hpp"

namespace perilink {

/// What the doubts about an explicit run have to know of it.
struct RunFacts {
  double peak_load = 0.0;  ///< largest load of the history [force]
  bool impact = false;     ///< moved by velocities: motion is what the run is about
  /// In which a wave goes along the body and back [time].
  double wave_time = 0.0;
  Index loose_pieces = 0;  ///< pieces of the body that nothing holds at the end
};

/// The longest side of the box around a body [length].
/// \param position  takes a particle and an axis: its coordinate [length]
template <class Position>
double longest_side(int dim, Index particles, Position position) {
  double longest = 0.0;
  for (int axis = 0; axis < dim && particles > 0; ++axis) {
    double lower = position(0, axis), upper = lower;
    for (Index i = 1; i < particles; ++i) {
      lower = std::min(lower, position(i, axis));
      upper = std::max(upper, position(i, axis));
    }
    longest = std::max(longest, upper - lower);
  }
  return longest;
}

inline double longest_side(const Particles& particles) {
  return longest_side(particles.dim, particles.size(),
                      [&](Index i, int axis) { return particles.position(i)[axis]; });
}

/// \param length  longest side of the body [length]
RunFacts run_facts(const CaseFile& input, double length, double peak_load);

/// What makes the numbers of an explicit run doubtful, a sentence each: energy that is missing or
/// too much by more than a hundredth of the work, a load that the supports do not feel, a run that
/// ends before a wave has come back, and more than a tenth of the work in motion at the end, unless
/// the run is an impact.
std::vector<std::string> warnings_about(const ExplicitResult& result, const RunFacts& facts);

/// The same of a dynamic relaxation: more energy stored and dissipated than its load steps saw as
/// work.
std::vector<std::string> warnings_at_rest(const EnergyBalance& energy);

/// A peak at displacements for which bonds of small displacements are not made.
/// \param length  longest side of the body [length]
std::optional<std::string> warning_about_size(const CurvePoint& peak, double length);

/// A last row in which the body has moved farther than it is long.
std::optional<std::string> warning_about_end(double displacement, double length);

/// The same of an elastic run: more than a hundredth of the bonds change by more than a tenth of
/// their lengths, longer or turned.
/// \param share  how many do, over all bonds or edges of linear elements [-]
std::optional<std::string> warning_about_motion(double share);

/// Compression of the particle where it is most times the tensile strength of its material.
struct Compression {
  double stress = 0.0;  ///< largest compressive principal one [force/length^2]
  double times = 0.0;   ///< that over the tensile strength [-]
};

/// Compression of particles whose material can break in tension only.
/// \param principal  stresses, shape (particles, 3)
Compression largest_compression(const Network& network, std::span<const double> principal);

/// A body that is compressed by more than ten times its tensile strength.
std::optional<std::string> warning_about_compression(const Compression& at_largest_load);

/// Energy that bonds have dissipated by softening in tension [force length].
struct SoftenedEnergy {
  double cracks = 0.0;   ///< by those that have lost a tenth of their fracture energy or more
  double diffuse = 0.0;  ///< by others: the body softens there without a crack
};
SoftenedEnergy softened_energy(const Network& network, Secants secants);

/// Diffuse softening of more than a tenth of the energy of the cracks.
std::optional<std::string> warning_about_diffuse_softening(const SoftenedEnergy& energy);

/// The largest load of a run that went on, or ended, where bonds are too short for small strains.
std::string warning_about_crushing(const CurvePoint& largest);

/// The same of a quasistatic run: energies that balance, or forces, to no more than six digits.
/// \param energy_error      largest of all rows, over the work [-]
/// \param largest_residual  forces out of balance, over the loads [-]
/// \param unsolved          what conjugate gradients have left of the answer, in the norm of energy
///                          [-]; 0 by a factor
std::vector<std::string> warnings_of_balance(double energy_error, double largest_residual,
                                             double unsolved = 0.0);

}  // namespace perilink
