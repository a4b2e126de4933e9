#pragma once

#include <optional>
#include <span>

#include "base/types.hpp"
#include "material/elasticity.hpp"

/// \file
/// Critical stretch of a brittle bond from the fracture energy G_F [force/length].

namespace perilink {

/// Returns the critical stretch for an infinite body [-] (Gerstle, Sau & Silling 2005, Eqs. 7b and
/// 7c): 2D G_F = c t s^2 delta^4 / 4, 3D G_F = pi c s^2 delta^5 / 10.
double continuum_critical_stretch(Problem problem, double fracture_energy, double micromodulus,
                                  double horizon, double thickness);

/// Returns the fracture sum Q of G_F = Q s_c^2 / 2 [force/length]. Q is twice the energy of all
/// bonds across a unit area of plane crack at unit stretch. For a unit normal e, Q(e) = sum over
/// unordered neighbours of c V xi |xi . e|. Each bond adds k xi^2, and a unit area has |xi . e| / V
/// bonds per neighbour. Without a normal it is the mean over all directions, with mean_cosine() for
/// |cos|.
double lattice_fracture_sum(Problem problem, std::span<const Vector3> offsets, double cell_volume,
                            double micromodulus, std::optional<Vector3> normal = std::nullopt);

/// Returns the mean of |cos| over all directions: 2/pi in two dimensions, 1/2 in three.
double mean_cosine(Problem problem);

/// Returns the fracture sum of bonds with any stiffness [force/length]. It is the mean over all
/// normals of Q(e) = sum over unordered neighbours of k xi^2 |xi . e| / V.
/// \param stiffness  k of the bond to each neighbour [force/length]
double fracture_sum_of_neighbourhood(Problem problem, std::span<const Vector3> offsets,
                                     std::span<const double> stiffness, double cell_volume);

/// Returns the critical stretch for which a straight crack through the lattice releases G_F [-].
double lattice_critical_stretch(double fracture_energy, double fracture_sum);

}  // namespace perilink
