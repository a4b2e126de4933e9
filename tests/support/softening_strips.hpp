#pragma once

#include <fmt/format.h>

#include <string>

/// \file
/// Strips with a softening middle.

namespace perilink::test {

/// Strip fixed at one end and displaced along x at the other; only its middle can soften.
struct SofteningStrip {
  std::string model = "bond_based";
  std::string pattern = "rectangular";
  std::string softening = "softening = \"linear\"";  ///< lines of the material
  double length = 100.0, width = 50.0;               ///< [length]
  double middle = 0.0;                               ///< [length]; zero: two horizons
  double spacing = 5.0;                              ///< a third of the horizon [length]
  double youngs_modulus = 30000.0;                   ///< [force/length^2]
  double tensile_strength = 3.0;                     ///< [force/length^2]
  double fracture_energy = 0.1;                      ///< [force/length]
  double pull = 0.1;                                 ///< prescribed displacement [length]
  std::string more;                                  ///< lines of [analysis] and the following
                                                     ///< tables
};

inline std::string softening_case(const SofteningStrip& strip) {
  const double half = strip.middle > 0.0 ? 0.5 * strip.middle : 3.0 * strip.spacing;
  const double middle = 0.5 * strip.length;
  const std::string ratio = strip.model == "micropolar" ? "poissons_ratio = 0.2\n" : "";
  return fmt::format(R"(title = "Softening strip"
[body]
problem = "plane_stress"
model = "{model}"
pattern = "{pattern}"
spacing = {spacing}
horizon_ratio = 3
[[regions]]
name = "strip"
x = [0, {length}]
y = [0, {width}]
[[regions]]
name = "middle"
x = [{begin}, {end}]
y = [0, {width}]
[[regions]]
name = "left"
x = [0, 0]
y = [0, {width}]
[[regions]]
name = "corner"
x = [0, 0]
y = [0, 0]
[[regions]]
name = "right"
x = [{length}, {length}]
y = [0, {width}]
[[materials]]
name = "ends"
region = "strip"
youngs_modulus = {modulus}
density = 2.4e-9
fracture_energy = "infinite"
{ratio}[[materials]]
name = "middle"
region = "middle"
youngs_modulus = {modulus}
density = 2.4e-9
fracture_energy = {energy}
tensile_strength = {strength}
{softening}
{ratio}[[supports]]
region = "left"
fix = ["x"]
[[supports]]
region = "corner"
fix = ["y"]
[[displacements]]
region = "right"
x = {pull}
[analysis]
{more}
)",
                     fmt::arg("model", strip.model), fmt::arg("pattern", strip.pattern),
                     fmt::arg("spacing", strip.spacing), fmt::arg("length", strip.length),
                     fmt::arg("width", strip.width), fmt::arg("begin", middle - half),
                     fmt::arg("end", middle + half), fmt::arg("modulus", strip.youngs_modulus),
                     fmt::arg("ratio", ratio), fmt::arg("energy", strip.fracture_energy),
                     fmt::arg("strength", strip.tensile_strength),
                     fmt::arg("softening", strip.softening), fmt::arg("pull", strip.pull),
                     fmt::arg("more", strip.more));
}

}  // namespace perilink::test
