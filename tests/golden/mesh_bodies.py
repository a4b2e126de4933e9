"""Small unstructured bodies that the golden cases start from. Units are N and mm."""

MESH_BODIES = {}

# A quarter of a plate with a hole, unstructured, pulled sideways.
MESH_BODIES["plate"] = """
[body]
mesh = "meshes/plate_with_hole.msh"
horizon_ratio = 3
[[regions]]
name = "plate"
group = "plate"
[[regions]]
name = "left side"
group = "left"
[[regions]]
name = "bottom"
group = "bottom"
[[regions]]
name = "right side"
group = "right"
[[regions]]
name = "far"
x = [2, 3]
y = [0, 3]
[[materials]]
region = "plate"
youngs_modulus = 30000
fracture_energy = 0.1
[[supports]]
region = "left side"
fix = ["x"]
[[supports]]
region = "bottom"
fix = ["y"]
[[displacements]]
region = "right side"
x = 0.001
[stop]
broken_bonds = 100
[output]
fields_at = [20]
"""

# A block with a round hole in space, unstructured, under forces that balance.
MESH_BODIES["pierced"] = """
[body]
problem = "three_dimensional"
mesh = "meshes/block_with_hole.msh"
horizon_ratio = 2
[[regions]]
name = "block"
group = "body"
[[regions]]
name = "left"
x = [-2, -2]
y = [-2, 2]
z = [0, 1]
[[regions]]
name = "right"
x = [2, 2]
y = [-2, 2]
z = [0, 1]
[[materials]]
region = "block"
youngs_modulus = 30000
fracture_energy = 0.1
[[tractions]]
region = "left"
pressure = -1
[[tractions]]
region = "right"
traction = [1, 0, 0]
[analysis]
rigid_body_modes = "pin"
"""

# An eighth of a hollow sphere under pressure inside, unstructured.
MESH_BODIES["sphere"] = """
[body]
problem = "three_dimensional"
mesh = "meshes/hollow_sphere.msh"
horizon_ratio = 2
[[regions]]
name = "sphere"
group = "sphere"
[[regions]]
name = "inner"
group = "inner"
[[materials]]
region = "sphere"
youngs_modulus = 30000
[[symmetry]]
axis = "x"
at = 0
[[symmetry]]
axis = "y"
at = 0
[[symmetry]]
axis = "z"
at = 0
[[tractions]]
region = "inner"
pressure = 1
[analysis]
type = "elastic"
"""
