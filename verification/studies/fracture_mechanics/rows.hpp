#pragma once

#include <numbers>
#include <vector>

/// \file
/// What the rows of a lattice do to a crack that takes the energy of the bonds which it cuts, and
/// nothing else: it runs where energy release over the energy of a straight crack is largest. The
/// release is that of the hoop stress, so that equal energies in all directions give its kinks.

namespace perilink::verification {

inline constexpr double degree = std::numbers::pi / 180.0;  ///< [radians]

class Rows {
 public:
  /// Bond-based bonds without a correction, a plane lattice along the axes.
  Rows(bool hexagonal, double horizon_ratio);

  /// Directions in which bonds lie, to and fro counted once.
  int count() const;

  /// Energy of a straight crack over the mean of all directions.
  /// \param angle  from x to the crack [radians]
  double energy(double angle) const;

  /// Direction of a crack that begins along x, in a lattice turned by an angle [radians].
  /// \param mixity  atan2(K_II, K_I) [radians]
  double direction(double mixity, double turned) const;

 private:
  struct Bond {
    double x, y, weight;
  };
  std::vector<Bond> bonds_;
  std::vector<double> energies_;  ///< energy() by steps of the angle
  double mean_ = 0.0;
};

}  // namespace perilink::verification
