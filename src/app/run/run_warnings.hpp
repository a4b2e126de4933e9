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

/// Data for the warnings about an explicit run.
struct RunFacts {
  double peak_load = 0.0;  ///< largest load of the history [force]
  bool impact = false;     ///< loaded by prescribed velocities, so that motion is expected
  /// Time in which an elastic wave crosses the body and returns [time].
  double wave_time = 0.0;
  Index loose_pieces = 0;  ///< unsupported pieces of the body at the end
  bool ramp_ends = true;   ///< within the duration
};

/// Returns the longest side of the box around a body [length].
/// \param position  takes a particle and an axis, returns the coordinate [length]
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

/// Returns the warnings about an explicit run: an energy error above a hundredth of the work, a
/// load not balanced by reactions, and a run shorter than the travel of a wave. Kinetic energy
/// above a tenth of the work warns too, except in impacts.
std::vector<std::string> warnings_about(const ExplicitResult& result, const RunFacts& facts);

/// Returns the warnings about a dynamic relaxation: more energy stored and dissipated than the work
/// of its load steps.
std::vector<std::string> warnings_at_rest(const ExplicitRecord& last);

/// Returns a warning about a peak beyond the range of small displacements.
/// \param length  longest side of the body [length]
std::optional<std::string> warning_about_size(const CurvePoint& peak, double length);

/// Returns a warning about a last displacement larger than the body.
std::optional<std::string> warning_about_end(double displacement, double length);

/// Returns a warning about large motion in an elastic run: more than a hundredth of the bonds
/// change by more than a tenth of their lengths.
/// \param share  their fraction of all bonds or edges of linear elements [-]
std::optional<std::string> warning_about_motion(double share);

/// Returns a warning where load steps dissipate more than the curve through their rows: elements
/// fail at the load factor at the end of a step.
/// \param area  under the rows [force length]
std::optional<std::string> warning_about_steps(const StepRecord& last, double area);

/// Compression of the particle with the largest ratio to the tensile strength of its material.
struct Compression {
  double stress = 0.0;  ///< largest compressive principal stress [force/length^2]
  double times = 0.0;   ///< stress over the tensile strength [-]

  template <class Archive>
  void serialize(Archive& archive) {
    archive(stress, times);
  }
};

/// Returns the largest compression of particles without a crushing law.
/// \param principal  stresses, shape (particles, 3)
/// \param damage     of the particles; those above one half are left out: loose pieces of a crack
Compression largest_compression(const Network& network, std::span<const double> principal,
                                std::span<const double> damage);

/// Returns a warning about compression above ten times the tensile strength.
std::optional<std::string> warning_about_compression(const Compression& at_largest_load);

/// Energy dissipated by softening bonds in tension [force length].
struct SoftenedEnergy {
  double cracks = 0.0;    ///< by bonds that have lost at least a tenth of their fracture energy
  double diffuse = 0.0;   ///< by other bonds, outside cracks
  double fracture = 0.0;  ///< fracture energy of the bonds of `cracks`
};
SoftenedEnergy softened_energy(const Network& network, Secants secants);

/// Returns a warning about diffuse softening above a tenth of the energy of the cracks. A process
/// zone that is still without a crack has lost less than half of its fracture energy: no warning.
std::optional<std::string> warning_about_diffuse_softening(const SoftenedEnergy& energy,
                                                           bool short_horizon);

/// Returns a warning about the largest load of a run with bonds compressed beyond small strains.
std::string warning_about_crushing(const CurvePoint& largest);

/// Returns the warnings about a quasistatic run with energies or forces balanced to fewer than six
/// digits.
/// \param energy_error      largest error of all rows, over the work [-]
/// \param largest_residual  forces out of balance, over the loads [-]
/// \param unsolved          error of conjugate gradients in the energy norm
///                          [-]; 0 with a factor
std::vector<std::string> warnings_of_balance(double energy_error, double largest_residual,
                                             double unsolved = 0.0);

}  // namespace perilink
