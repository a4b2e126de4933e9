#pragma once

#include <span>

#include "material/micropolar.hpp"

/// \file
/// Elastic size effect of Gerstle, Sau & Aguilera (2007), section 5: a particle at the depth a
/// below a plane surface has lost the bonds that would cross it. In a homogeneous strain, particles
/// not rotated, it stores the energy of a solid that is softer, most of all along the normal of the
/// surface. Axis 1 is that normal; 2, and 3 in three dimensions, lie in the surface.

namespace perilink::verification {

/// Stiffness of a transversely isotropic solid in normal strains [force/length^2].
struct LayerStiffness {
  double c11 = 0.0;
  double c12 = 0.0;
  double c22 = 0.0;
  double c23 = 0.0;  ///< three dimensions only
};

/// Its moduli. nu12 = - strain 2 / strain 1 where stress 1 acts alone.
struct LayerModuli {
  double e1 = 0.0;    ///< Young's modulus across the layer [force/length^2]
  double e2 = 0.0;    ///< Young's modulus along the layer [force/length^2]
  double nu12 = 0.0;  ///< [-]
  double nu2 = 0.0;   ///< nu23 in three dimensions, nu21 in two [-]
};

/// \param problem  plane stress or three-dimensional
LayerModuli layer_moduli(Problem problem, const LayerStiffness& stiffness);

/// Closed form of the continuum, thickness 1 in plane stress; derived in docs/theory/micropolar.md.
/// \param depth  a / horizon [-]; beyond 1 the infinite body
LayerStiffness layer_stiffness(Problem problem, const MicropolarModuli& moduli, double horizon,
                               double depth);

/// Mean of the closed form over a plate of a width between two surfaces: what each surface takes
/// away is taken away once, since no bond is cut by both.
/// \param width  [horizons]
LayerStiffness plate_stiffness(Problem problem, const MicropolarModuli& moduli, double horizon,
                               double width);

}  // namespace perilink::verification
