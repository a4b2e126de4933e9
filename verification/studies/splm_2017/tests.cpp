#include "tests.hpp"

#include <cmath>

namespace perilink::verification {
namespace {

/// Printed in 2018 for the same specimens; the thesis prints none.
constexpr double printed_block_step = 6.55e-7, printed_disc_step = 3.27e-7;
constexpr double disc_radius = 0.075, disc_spacing = 0.005;
/// Fundamental periods per run; the thesis leaves the number to Gerstle (2015), 2018 has 120 of
/// them in its tension test.
constexpr double periods = 120.0;

double step_of(const std::string& variant, double printed) {
  return variant == "consistent" ? 0.0 : printed;
}

/// Table 1: f_c' = 27.58 MPa. Young's modulus by Eq. 5.2, the critical opening by Eqs. 5.3 and 5.4.
void set_material(CaseFile& input, double period) {
  MaterialSection& concrete = input.materials.front();
  constexpr double energy_ratio = (27.58 + 8.0) / 10.0;  // f_cm over f_cm0
  constexpr double strength = 2.6168e6;
  concrete.youngs_modulus = 25.13e9;
  concrete.lattice->tensile_strength = strength;
  concrete.lattice->critical_opening =
      2.0 * 33.49 * std::pow(energy_ratio, 0.7) / (strength * (0.1 + 0.25));
  concrete.lattice->fundamental_period = period;
  if (concrete.lattice->yield_strength) concrete.lattice->yield_strength = 22.983e6;
}

void drive(CaseFile& input, double factor) {
  for (DisplacementSection& section : input.displacements) {
    if (section.value[1]) section.value[1]->number *= factor;
  }
}

}  // namespace

LatticeTest tension_test(const std::string& variant, double degrees) {
  LatticeTest test;
  test.case_name = "splm_tension";
  test.variant = variant;
  test.degrees = degrees;
  test.time_step = step_of(variant, printed_block_step);
  test.change = [](CaseFile& input) {
    const double opening = *input.materials.front().lattice->critical_opening;
    set_material(input, 0.00042);
    drive(input, *input.materials.front().lattice->critical_opening / opening);
  };
  return test;
}

LatticeTest compression_test(const std::string& variant, double degrees) {
  LatticeTest test = tension_test(variant, degrees);
  test.case_name = "splm_compression";
  return test;
}

LatticeTest cylinder_test(const std::string& variant, double degrees) {
  LatticeTest test;
  test.case_name = "brazilian_disc";
  test.variant = variant;
  test.degrees = degrees;
  test.time_step = step_of(variant, printed_disc_step);
  test.change = [](CaseFile& input) {
    const double opening = *input.materials.front().lattice->critical_opening;
    set_material(input, 0.0002321);
    drive(input, *input.materials.front().lattice->critical_opening / opening);
    input.body.thickness = 0.3;
  };
  return test;
}

LatticeTest dog_bone_test(const std::string& variant, char specimen, double spacing) {
  LatticeTest test;
  test.case_name = "dog_bone";
  test.variant = variant;
  test.spacing = spacing;
  const double scale = specimen == 'D' ? 4.0 : 1.0;
  const double period = specimen == 'D' ? 0.0017 : 0.00042;
  test.change = [scale, period, spacing](CaseFile& input) {
    for (Region& region : input.regions) {
      for (int axis = 0; axis < 2; ++axis) {
        region.box.lower[axis] *= scale;
        region.box.upper[axis] *= scale;
        if (region.round) region.round->center[axis] *= scale;
      }
      if (region.round) region.round->radius *= scale;
      // Two rows at either end.
      if (region.name == "upper end") region.box.lower[1] = region.box.upper[1] - 1.5 * spacing;
      if (region.name == "lower end") region.box.upper[1] = region.box.lower[1] + 1.5 * spacing;
    }
    input.analysis.duration = periods * period;
    input.analysis.ramp_time = 0.8 * input.analysis.duration;
  };
  return test;
}

}  // namespace perilink::verification
