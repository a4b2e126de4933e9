#pragma once

#include "material/elasticity.hpp"
#include "material/strength/bond_cell.hpp"

namespace perilink::test {

/// Point of a stress-strain curve under uniform strain for the law of Gerstle, Sau & Aguilera
/// (2007), section 6. Source: independent integration of the law in plane stress, with the
/// constants of the paper's Eqs. 15 and 17. These are E = 24850, nu = 0.22, and the limits 0.00014
/// in tension (softening to twice that) and 0.001 in compression (to three times that).
struct ConcretePoint {
  Problem constants;
  bool keeps_shear;  ///< shear stays elastic until the bond breaks
  Across across;
  double strain, stress;  ///< negative in compression
};

/// Five points per curve; the fourth has the largest stress.
inline constexpr ConcretePoint concrete_points[] = {
    {Problem::plane_stress, true, Across::held, 0.0001, 2.61139},
    {Problem::plane_stress, true, Across::held, 0.00018, 4.2022},
    {Problem::plane_stress, true, Across::held, 0.00023, 4.54612},
    {Problem::plane_stress, true, Across::held, 0.00028, 4.77709},
    {Problem::plane_stress, true, Across::held, 0.00036, 2.35073},
    {Problem::plane_stress, true, Across::free, 0.0001, 2.485},
    {Problem::plane_stress, true, Across::free, 0.00018, 4.02312},
    {Problem::plane_stress, true, Across::free, 0.00023, 4.39615},
    {Problem::plane_stress, true, Across::free, 0.00028, 4.66157},
    {Problem::plane_stress, true, Across::free, 0.00036, 2.46619},
    {Problem::plane_stress, true, Across::free, -0.0006, -14.91},
    {Problem::plane_stress, true, Across::free, -0.0009, -22.2472},
    {Problem::plane_stress, true, Across::free, -0.0015, -28.1097},
    {Problem::plane_stress, true, Across::free, -0.003, -35.054},
    {Problem::plane_stress, true, Across::free, -0.0036, -22.4479},
    {Problem::plane_stress, false, Across::held, 0.0001, 2.61139},
    {Problem::plane_stress, false, Across::held, 0.00018, 4.19555},
    {Problem::plane_stress, false, Across::held, 0.00023, 4.50955},
    {Problem::plane_stress, false, Across::held, 0.00028, 4.69218},
    {Problem::plane_stress, false, Across::held, 0.00036, 2.23624},
    {Problem::plane_stress, false, Across::free, 0.0001, 2.485},
    {Problem::plane_stress, false, Across::free, 0.00018, 4.01593},
    {Problem::plane_stress, false, Across::free, 0.00023, 4.35761},
    {Problem::plane_stress, false, Across::free, 0.00028, 4.57382},
    {Problem::plane_stress, false, Across::free, 0.00036, 2.36183},
    {Problem::plane_stress, false, Across::free, -0.0006, -14.91},
    {Problem::plane_stress, false, Across::free, -0.0009, -22.2281},
    {Problem::plane_stress, false, Across::free, -0.0015, -27.5163},
    {Problem::plane_stress, false, Across::free, -0.003, -32.0653},
    {Problem::plane_stress, false, Across::free, -0.0036, -20.0476},
    {Problem::plane_strain, true, Across::held, 0.0001, 2.83709},
    {Problem::plane_strain, true, Across::held, 0.00018, 4.53786},
    {Problem::plane_strain, true, Across::held, 0.00023, 4.85836},
    {Problem::plane_strain, true, Across::held, 0.00028, 5.0499},
    {Problem::plane_strain, true, Across::held, 0.00036, 2.25028},
    {Problem::plane_strain, true, Across::free, 0.0001, 2.61139},
    {Problem::plane_strain, true, Across::free, 0.00018, 4.19999},
    {Problem::plane_strain, true, Across::free, 0.00023, 4.54001},
    {Problem::plane_strain, true, Across::free, 0.00028, 4.76242},
    {Problem::plane_strain, true, Across::free, 0.00036, 2.28795},
    {Problem::plane_strain, true, Across::free, -0.0006, -15.5968},
    {Problem::plane_strain, true, Across::free, -0.0009, -18.025},
    {Problem::plane_strain, true, Across::free, -0.0015, -22.8399},
    {Problem::plane_strain, true, Across::free, -0.003, -28.0941},
    {Problem::plane_strain, true, Across::free, -0.0036, -17.228},
    {Problem::plane_strain, false, Across::held, 0.0001, 2.83709},
    {Problem::plane_strain, false, Across::held, 0.00018, 4.53459},
    {Problem::plane_strain, false, Across::held, 0.00023, 4.84038},
    {Problem::plane_strain, false, Across::held, 0.00028, 5.00816},
    {Problem::plane_strain, false, Across::held, 0.00036, 2.19399},
    {Problem::plane_strain, false, Across::free, 0.0001, 2.61139},
    {Problem::plane_strain, false, Across::free, 0.00018, 4.19635},
    {Problem::plane_strain, false, Across::free, 0.00023, 4.52038},
    {Problem::plane_strain, false, Across::free, 0.00028, 4.71748},
    {Problem::plane_strain, false, Across::free, 0.00036, 2.23342},
    {Problem::plane_strain, false, Across::free, -0.0006, -15.5947},
    {Problem::plane_strain, false, Across::free, -0.0009, -17.6702},
    {Problem::plane_strain, false, Across::free, -0.0015, -22.2466},
    {Problem::plane_strain, false, Across::free, -0.003, -25.8869},
    {Problem::plane_strain, false, Across::free, -0.0036, -15.6438},
};

}  // namespace perilink::test
