"""Small shells, beams and state-based bodies that the golden cases start from."""

THIN_BODIES = {}

# A quarter of a clamped plate under pressure. 121 particles. [N, mm]
THIN_BODIES["clamped_plate"] = """
[body]
problem = "shell"
thickness = 4
spacing = 10
horizon_ratio = 3
[[regions]]
name = "plate"
x = [0, 100]
y = [0, 100]
[[regions]]
name = "right edge"
x = [100, 100]
y = [0, 100]
[[regions]]
name = "upper edge"
x = [0, 100]
y = [100, 100]
[[materials]]
region = "plate"
youngs_modulus = 70000
poissons_ratio = 0.22
fracture_energy = 0.008
[[supports]]
region = "right edge"
fix = ["x", "y", "z", "rx", "ry", "rz"]
[[supports]]
region = "upper edge"
fix = ["x", "y", "z", "rx", "ry", "rz"]
[[symmetry]]
axis = "x"
at = 0
[[symmetry]]
axis = "y"
at = 0
[[loads]]
region = "body"
body_force = [0, 0, -0.00025]
[[gauges]]
name = "middle"
at = [0, 0]
axis = "z"
[stop]
broken_bonds = 100
[output]
fields_at = [40]
"""

# A piece of a cylinder on two edges under its weight. 117 particles. [lb, ft]
THIN_BODIES["roof"] = """
[body]
problem = "shell"
thickness = 0.25
radius = 25
columns = 9
horizon_ratio = 3
[[regions]]
name = "quarter"
x = [0, 17.453292519943295]
y = [0, 25]
[[regions]]
name = "diaphragm"
x = [0, 17.453292519943295]
y = [25, 25]
[[materials]]
region = "quarter"
youngs_modulus = 4.32e8
poissons_ratio = 0.0
fracture_energy = "infinite"
[[supports]]
region = "diaphragm"
fix = ["x", "z"]
[[symmetry]]
axis = "x"
at = 0
[[symmetry]]
axis = "y"
at = 0
[[loads]]
region = "body"
body_force = [0, 0, -360]
[analysis]
type = "elastic"
"""

# A beam of two heights on two supports under two forces. 61 particles. [N, mm]
THIN_BODIES["timber"] = """
[body]
problem = "beam"
thickness = 60
spacing = 50
horizon_ratio = 1
[[regions]]
name = "left part"
x = [0, 1000]
y = [-60, 60]
[[regions]]
name = "haunch"
x = [1000, 2000]
y = [-80, 80]
[[regions]]
name = "right part"
x = [2000, 3000]
y = [-60, 60]
[[regions]]
name = "left end"
x = [0, 0]
y = [-60, 60]
[[regions]]
name = "right end"
x = [3000, 3000]
y = [-60, 60]
[[materials]]
regions = ["left part", "haunch", "right part"]
youngs_modulus = 11000
fracture_energy = 50
[[supports]]
region = "left end"
fix = ["x", "y"]
[[supports]]
region = "right end"
fix = ["y"]
[[point_loads]]
at = [1000, 0]
force = [0, -1000]
[[point_loads]]
at = [2000, 0]
force = [0, -1000]
[[gauges]]
name = "middle"
at = [1500, 0]
axis = "y"
[output]
fields_every_rows = 20
"""

# A block of a hexagonal lattice, pulled at its upper end. About 170 particles. [N, m]
THIN_BODIES["lattice"] = """
[body]
model = "lattice"
thickness = 0.15
spacing = 0.02
[[regions]]
name = "block"
x = [-0.0776, 0.0776]
y = [-0.1658, 0.1658]
[[regions]]
name = "lower end"
x = [-0.0776, 0.0776]
y = [-0.1658, -0.14]
[[regions]]
name = "upper end"
x = [-0.0776, 0.0776]
y = [0.14, 0.1658]
[[regions]]
name = "hole"
center = [0.03, 0]
radius = 0.025
[[materials]]
name = "concrete"
region = "block"
youngs_modulus = 25e9
poissons_ratio = 0.2
density = 2323
tensile_strength = 2.62e6
critical_opening = 2e-4
internal_damping = 0.2
external_damping = 0.2
[[supports]]
region = "lower end"
fix = ["y"]
[[displacements]]
region = "upper end"
y = 3e-4
[analysis]
type = "explicit"
duration = 0.02
ramp_time = 0.016
rows = 100
[output]
fields_times = [0.008]
"""

# A bar of a face-centred lattice, drawn out within a second. [N, m]
THIN_BODIES["lattice_bar"] = """
[body]
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
tensile_strength = 1
critical_opening = 0.04
[[supports]]
region = "lower end"
fix = ["x", "y", "z"]
[[displacements]]
region = "upper end"
y = 0.1
[analysis]
type = "explicit"
duration = 20
rows = 50
[output]
fields_times = [10]
"""

# State-based particles at the vertices of a plate with a hole, pulled upwards. [N, cm, s]
THIN_BODIES["particles"] = """
[body]
model = "particles"
mesh = "meshes/full_plate_with_hole.msh"
[[regions]]
name = "plate"
group = "plate"
[[regions]]
name = "bottom end"
x = [-3, 3]
y = [-3, -2.2]
[[regions]]
name = "top end"
x = [-3, 3]
y = [2.2, 3]
[[regions]]
name = "bottom"
group = "bottom"
[[regions]]
name = "top"
group = "top"
[[materials]]
region = "plate"
youngs_modulus = 2.5e6
poissons_ratio = 0.2
density = 2.323e-5
tensile_strength = 262
fracture_energy = 0.917
[[materials]]
regions = ["bottom end", "top end"]
youngs_modulus = 2.5e6
poissons_ratio = 0.2
density = 2.323e-5
fracture_energy = "infinite"
[[supports]]
region = "bottom"
fix = ["x", "y"]
[[displacements]]
region = "top"
x = 0
y = 0.004
[analysis]
type = "explicit"
duration = 0.002
ramp_time = 0.0018
safety = 0.5
damping_rate = 40000
rows = 50
[output]
fields_times = [0.001]
"""
