#pragma once

#include <string>

#include "base/error.hpp"
#include "io/case/case_file.hpp"
#include "support/replaced.hpp"

/// \file
/// Base cases for tests of the reader.

namespace perilink {

inline const char* const small_case = R"([body]
columns = 11
horizon_ratio = 3

[[regions]]
name = "block"
x = [0, 1]
y = [0, 2]

[[materials]]
region = "block"
youngs_modulus = 30
fracture_energy = 0.1

[[loads]]
region = "block"
force = [0, -1]
)";

inline const char* const full_case = R"(title = "Say \"beam\" \\ Träger"
units = "kN, m"

[body]
problem = "three_dimensional"
pattern = "face_centred"
spacing = 0.1
horizon = 0.25
surface = "none"
micromodulus = "continuum"
critical_stretch = "continuum"

[[regions]]
name = "beam"
x = [0, 1]
y = [-2.5, 2.5e0]
z = [0, 0.333333333333333314829616256247390992939472198486328125]

[[regions]]
name = "cap"
x = [0, 1]
y = [2.5, 3]
z = [0, 1]

[[materials]]
name = "concrete"
region = "beam"
youngs_modulus = 30e6
poissons_ratio = 0.25
fracture_energy = 0.1

[[materials]]
regions = ["cap"]
youngs_modulus = 1e-2
fracture_energy = "infinite"

[[supports]]
region = "beam"
fix = ["z", "x"]

[[displacements]]
region = "cap"
x = 0.1
z = -1

[[cracks]]
corners = [[0, 0, 0], [0.5, 0, 0], [0.5, 0, 0.25]]

[[loads]]
region = "cap"
body_force = [0, 0, -25]

[[loads]]
region = "beam"
force = [1, 2, 3]

[[rebar]]
from = [0.5, -2.5, 0.05]
to = [0.5, 3, 0.05]
youngs_modulus = 2e8
area = 1e-4
yield_strength = 500e3
yields = false
bond = "concrete"
ties_break = false

[[rebar]]
from = [0.5, -2.5, 0.1]
to = [0.5, 3, 0.1]
youngs_modulus = 2e8
area = 1e-4

[analysis]
control = "steps"
load_factors = [0.1, 0.2, 1]
rigid_body_modes = "pin"
factor = "cholmod_updown"

[stop]
broken_bonds = 10
load_fraction = 0.1
displacement = 0.3

[output]
fields_at = [1, 20]
fields_every = 50
)";

inline const char* const mesh_case = R"([body]
mesh = "meshes/plate \"a\".msh"
horizon_ratio = 3

[[regions]]
name = "block"
group = "plate"

[[regions]]
name = "right"
x = [3, 3]
y = [0, 3]

[[materials]]
region = "block"
youngs_modulus = 30
fracture_energy = 0.1

[[loads]]
region = "right"
force = [0, -1]

[[cracks]]
points = [[0, 0.125], [1, 2], [3, 4.5]]
)";

inline const char* const lattice_case = R"([body]
model = "lattice"
spacing = 0.1
rotation = 15
offset = [0.025, 0]
variant = "2018"

[[regions]]
name = "block"
x = [0, 1]
y = [0, 2]

[[regions]]
name = "top"
x = [0, 1]
y = [1.8, 2]

[[materials]]
region = "block"
youngs_modulus = 30
poissons_ratio = 0.2
density = 2.5
tensile_strength = 0.003
fracture_energy = 1e-5
external_damping = 0.05
fundamental_period = 0.7

[[displacements]]
region = "top"
y = "0.001*x"

[analysis]
type = "explicit"
duration = 4
time_step = 0.001

[output]
fields_times = [0.5, 4]
)";

/// Returns the reader's message for a refused case, or "accepted".
inline std::string message_of(const std::string& text) {
  try {
    parse_case(text, "case.toml");
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

}  // namespace perilink
