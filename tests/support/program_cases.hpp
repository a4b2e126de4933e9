#pragma once

#include <fmt/format.h>

#include <string>

/// \file
/// Case files for tests of the program.

namespace perilink::test {

/// A few hundred particles with ghosts in tension until 30 bonds are broken; takes less than a
/// second.
inline constexpr const char* small_ghost_case = R"(title = "Small block"
units = "kip, in"

[body]
thickness = 1.0
surface = "ghost"
spacing = 12.5
horizon = 31.45

[[regions]]
name = "specimen"
x = [0, 100]
y = [0, 200]

[[regions]]
name = "lower cap"
x = [0, 100]
y = [-50, 0]

[[regions]]
name = "upper cap"
x = [0, 100]
y = [200, 250]

[[materials]]
region = "specimen"
youngs_modulus = 3604.0
fracture_energy = 0.001

[[materials]]
regions = ["lower cap", "upper cap"]
youngs_modulus = 3604.0
fracture_energy = "infinite"

[[loads]]
region = "lower cap"
force = [0, -100]

[[loads]]
region = "upper cap"
force = [0, 100]

[analysis]
rigid_body_modes = "pin"

[stop]
broken_bonds = 30

[output]
fields_at = [10, 20]
)";

/// Returns a hexagonal block of 100 by 300 with a weak patch, fixed below and displaced above; it
/// has 3.5 columns^2 particles.
inline std::string hexagonal_case(int columns, int broken_bonds) {
  return fmt::format(R"(title = "Hexagonal block"

[body]
pattern = "hexagonal"
columns = {}
horizon_ratio = 3

[[regions]]
name = "block"
x = [0, 100]
y = [0, 300]

[[regions]]
name = "weak patch"
x = [40, 60]
y = [140, 160]

[[regions]]
name = "lower end"
x = [0, 100]
y = [0, 10]

[[regions]]
name = "upper end"
x = [0, 100]
y = [290, 300]

[[materials]]
region = "block"
youngs_modulus = 3604.0
fracture_energy = 0.001

[[materials]]
region = "weak patch"
youngs_modulus = 3604.0
fracture_energy = 0.0009

[[supports]]
region = "lower end"
fix = ["x", "y"]

[[displacements]]
region = "upper end"
x = 0
y = 0.1

[stop]
broken_bonds = {}
)",
                     columns, broken_bonds);
}

/// Strip of 2 by 1 whose ends are displaced apart by 0.04 while it contracts freely, so the strain
/// is 0.02. With the modulus 100 it should store 100 * 0.02^2 / 2 * 2 = 0.04. Its ends are lines; a
/// ghost lattice has no particles there.
inline constexpr const char* tension_strip_case = R"([body]
surface = "none"
spacing = 0.25
horizon = 0.6

[[regions]]
name = "strip"
x = [0, 2]
y = [0, 1]

[[regions]]
name = "left side"
x = [0, 0]
y = [0, 1]

[[regions]]
name = "corner"
x = [0, 0]
y = [0, 0]

[[regions]]
name = "right side"
x = [2, 2]
y = [0, 1]

[[materials]]
region = "strip"
youngs_modulus = 100
fracture_energy = "infinite"

[[supports]]
region = "left side"
fix = ["x"]

[[supports]]
region = "corner"
fix = ["y"]

[[displacements]]
region = "right side"
x = 0.04

[analysis]
type = "elastic"
)";

/// Returns a strip of an elastic lattice of about 250 particles, fixed at one end and stretched at
/// the other within a second.
/// \param more  lines of [analysis]
inline std::string lattice_strip_case(double spacing = 0.1, const std::string& more = "") {
  return fmt::format(R"(title = "Lattice strip"
units = "N, m"

[body]
model = "lattice"
spacing = {}

[[regions]]
name = "strip"
x = [0, 2]
y = [0, 1]

[[regions]]
name = "left side"
x = [0, 0.1]
y = [0, 1]

[[regions]]
name = "right side"
x = [1.9, 2]
y = [0, 1]

[[materials]]
region = "strip"
youngs_modulus = 100
poissons_ratio = 0.2
density = 1
fracture_energy = "infinite"
internal_damping = 0.1

[[supports]]
region = "left side"
fix = ["x", "y"]

[[displacements]]
region = "right side"
x = 0.04

[analysis]
type = "explicit"
duration = 2
ramp_time = 1
rows = 100
{})",
                     spacing, more);
}

/// Returns a bar of an elastic face-centred lattice, stretched within a second.
inline std::string lattice_bar_case() {
  return R"([body]
problem = "three_dimensional"
model = "lattice"
spacing = 0.25

[[regions]]
name = "bar"
x = [0, 1]
y = [0, 2]
z = [0, 1]

[[regions]]
name = "lower end"
x = [0, 1]
y = [0, 0.2]
z = [0, 1]

[[regions]]
name = "upper end"
x = [0, 1]
y = [1.8, 2]
z = [0, 1]

[[materials]]
region = "bar"
youngs_modulus = 100
poissons_ratio = 0.2
density = 1
fracture_energy = "infinite"

[[supports]]
region = "lower end"
fix = ["x", "y", "z"]

[[displacements]]
region = "upper end"
y = 0.02

[analysis]
type = "explicit"
duration = 1
rows = 20

[output]
fields_times = [0.5]
)";
}

/// Returns a bar of 1 by 1 by 4 with the modulus 100 in tension of 2 along y; its supports allow
/// contraction.
inline std::string tension_bar_case(const std::string& pattern, double spacing,
                                    const std::string& surface) {
  return fmt::format(R"([body]
problem = "three_dimensional"
pattern = "{}"
spacing = {}
horizon_ratio = 2
surface = "{}"

[[regions]]
name = "bar"
x = [0, 1]
y = [0, 4]
z = [0, 1]

[[regions]]
name = "lower face"
x = [0, 1]
y = [-0.01, 0.01]
z = [0, 1]

[[regions]]
name = "edge along z"
x = [-0.01, 0.01]
y = [-0.01, 0.01]
z = [0, 1]

[[regions]]
name = "edge along x"
x = [0, 1]
y = [-0.01, 0.01]
z = [-0.01, 0.01]

[[regions]]
name = "upper face"
x = [0, 1]
y = [3.99, 4.01]
z = [0, 1]

[[materials]]
region = "bar"
youngs_modulus = 100
fracture_energy = 0.001

[[supports]]
region = "lower face"
fix = ["y"]

[[supports]]
region = "edge along z"
fix = ["x"]

[[supports]]
region = "edge along x"
fix = ["z"]

[[loads]]
region = "upper face"
force = [0, 2, 0]

[analysis]
type = "elastic"
)",
                     pattern, spacing, surface);
}

}  // namespace perilink::test
