#pragma once

#include <optional>
#include <span>

#include "base/types.hpp"
#include "material/elasticity.hpp"

/// \file
/// The stretch at which a brittle bond breaks, from the fracture energy G_F [force/length].

namespace perilink {

/// Critical stretch of the infinite body: 2D G_F = c t s^2 delta^4 / 4, 3D G_F = pi c s^2 delta^5 /
/// 10 (Gerstle, Sau & Silling 2005, Eqs. 7b and 7c).
double continuum_critical_stretch(Problem problem, double fracture_energy, double micromodulus,
                                  double horizon, double thickness);

/// Energy that all bonds across a unit area of plane crack hold at unit stretch, twice: the Q of
/// G_F = Q s_c^2 / 2 [force/length]. For a crack with unit normal e, Q(e) = sum over unordered
/// neighbours of c V xi |xi . e| (k xi^2 per bond, |xi . e| / V bonds of each kind per unit area);
/// without a normal the mean over all directions (2/pi in 2D, 1/2 in 3D, of |cos|).
double lattice_fracture_sum(Problem problem, std::span<const Vector3> offsets, double cell_volume,
                            double micromodulus, std::optional<Vector3> normal = std::nullopt);

/// Mean of |cos| over all directions: 2/pi in two dimensions, 1/2 in three.
double mean_cosine(Problem problem);

/// The fracture sum of bonds whose stiffness does not follow from one micromodulus: the mean over
/// all normals of Q(e) = sum over unordered neighbours of k xi^2 |xi . e| / V [force/length].
/// \param stiffness  k of the bond to each neighbour [force/length]
double fracture_sum_of_neighbourhood(Problem problem, std::span<const Vector3> offsets,
                                     std::span<const double> stiffness, double cell_volume);

/// Critical stretch with which a straight crack through the lattice releases G_F.
double lattice_critical_stretch(double fracture_energy, double fracture_sum);

}  // namespace perilink
