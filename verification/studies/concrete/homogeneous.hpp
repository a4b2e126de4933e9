#pragma once

#include <string>
#include <vector>

/// \file
/// A square of concrete that strains uniformly whatever breaks in it.

namespace perilink::verification {

/// How it is made up and driven.
struct Homogeneous {
  std::string layout;          ///< lines of [body] that fill it with particles
  bool shear_softens = false;  ///< rule B of the law; else rule A
  bool held_across = false;    ///< eps_2 = 0; else eps_2 is free, so that sigma_2 = 0
  bool compression = false;
  double error = 0.001;         ///< softening_error: bonds of one direction pass their teeth
                                ///< together, so that their ripple does not average out
  std::vector<double> strains;  ///< sizes of eps_1 at which stresses are asked for, rising
};

/// What the forces of the bonds make of the inner part.
struct HomogeneousPoint {
  double strain = 0.0, strain_across = 0.0;
  double stress = 0.0, stress_across = 0.0;  ///< [N/mm^2]
};

/// One point for each strain. The particles have eps_1 x, 0 without rotations; free across, they
/// move by q y / width along y, where q is the one unknown that is left. Bonds break event by
/// event as in any run.
std::vector<HomogeneousPoint> strain_uniformly(const Homogeneous& specimen);

/// A curve of reference.csv: one rule, one condition across, one sense.
struct ReferenceCurve {
  bool shear_softens = false, held_across = false;
  std::vector<HomogeneousPoint> points;
};
std::vector<ReferenceCurve> read_reference();

}  // namespace perilink::verification
