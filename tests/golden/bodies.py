"""Small bodies that the golden cases start from. Units of bodies of bonds are N, mm and s."""

BODIES = {}

# A strip with a crack in its edge, pulled at its upper end. 231 particles.
BODIES["strip"] = """
[body]
spacing = 5
horizon_ratio = 3
thickness = 10
[[regions]]
name = "strip"
x = [0, 50]
y = [0, 100]
[[regions]]
name = "lower grip"
x = [0, 50]
y = [0, 15]
[[regions]]
name = "upper grip"
x = [0, 50]
y = [85, 100]
[[regions]]
name = "lower end"
x = [0, 50]
y = [0, 0]
[[regions]]
name = "upper end"
x = [0, 50]
y = [100, 100]
[[regions]]
name = "weak patch"
x = [20, 40]
y = [40, 60]
[[materials]]
name = "concrete"
region = "strip"
youngs_modulus = 30000
fracture_energy = 0.1
[[materials]]
name = "grips"
regions = ["lower grip", "upper grip"]
youngs_modulus = 30000
fracture_energy = "infinite"
[[cracks]]
points = [[-1, 52], [11, 52]]
[[supports]]
region = "lower end"
fix = ["x", "y"]
[[supports]]
region = "upper end"
fix = ["x"]
[[displacements]]
region = "upper end"
y = 0.1
[stop]
broken_bonds = 120
[output]
fields_every = 50
"""

# A notched beam in three-point bending, whose ends do not break. 451 particles.
BODIES["beam"] = """
[body]
spacing = 3
horizon_ratio = 3
thickness = 10
[[regions]]
name = "beam"
x = [-60, 60]
y = [0, 30]
[[regions]]
name = "left end"
x = [-60, -15]
y = [0, 30]
[[regions]]
name = "right end"
x = [15, 60]
y = [0, 30]
[[regions]]
name = "left support"
x = [-54, -54]
y = [0, 0]
[[regions]]
name = "right support"
x = [54, 54]
y = [0, 0]
[[regions]]
name = "load"
x = [-3, 3]
y = [30, 30]
[[materials]]
name = "concrete"
region = "beam"
youngs_modulus = 30000
fracture_energy = 0.1
[[materials]]
name = "unbreakable"
regions = ["left end", "right end"]
youngs_modulus = 30000
fracture_energy = "infinite"
[[cracks]]
points = [[1.5, -1], [1.5, 10]]
[[supports]]
region = "left support"
fix = ["x", "y"]
[[supports]]
region = "right support"
fix = ["y"]
[[displacements]]
region = "load"
y = -0.1
[[gauges]]
name = "mouth"
between = [[0, 0], [3, 0]]
[[gauges]]
name = "stress_ahead"
at = [1, 16]
stress = "xx"
[stop]
load_fraction = 0.5
[output]
fields_every = 100
"""

# A reinforced beam in three-point bending, without a notch. 343 particles.
BODIES["reinforced"] = """
[body]
spacing = 5
horizon_ratio = 3
thickness = 50
[[regions]]
name = "beam"
x = [-120, 120]
y = [0, 30]
[[regions]]
name = "left support"
x = [-110, -110]
y = [0, 0]
[[regions]]
name = "right support"
x = [110, 110]
y = [0, 0]
[[regions]]
name = "load"
x = [-10, 10]
y = [30, 30]
[[regions]]
name = "pads"
x = [-20, 20]
y = [20, 30]
[[materials]]
name = "concrete"
region = "beam"
youngs_modulus = 30000
fracture_energy = 0.1
[[materials]]
name = "unbreakable"
regions = ["pads"]
youngs_modulus = 30000
fracture_energy = "infinite"
[[supports]]
region = "left support"
fix = ["x", "y"]
[[supports]]
region = "right support"
fix = ["y"]
[[displacements]]
region = "load"
y = -0.1
[stop]
broken_bonds = 150
displacement = 1
[output]
fields_at = [50]
"""

# Two arms joined along y = 15, pulled apart at their left ends. 451 particles.
BODIES["joint"] = """
[body]
spacing = 3
horizon_ratio = 3
[[regions]]
name = "lower"
x = [0, 120]
y = [0, 15]
[[regions]]
name = "upper"
x = [0, 120]
y = [15, 30]
[[regions]]
name = "lower pull"
x = [0, 0]
y = [0, 0]
[[regions]]
name = "upper pull"
x = [0, 0]
y = [30, 30]
[[regions]]
name = "end"
x = [120, 120]
y = [0, 30]
[[materials]]
region = "lower"
youngs_modulus = 30000
fracture_energy = "infinite"
[[materials]]
region = "upper"
youngs_modulus = 30000
fracture_energy = "infinite"
[[interfaces]]
between = ["lower", "upper"]
fracture_energy = 0.05
[[cracks]]
points = [[-1, 15], [40, 15]]
[[supports]]
region = "end"
fix = ["x", "y"]
[[displacements]]
region = "upper pull"
y = 0.1
[[displacements]]
region = "lower pull"
y = -0.1
[stop]
load_fraction = 0.6
broken_bonds = 150
[output]
fields_every = 60
"""

# A bar in space with a crack in one face, pulled at its upper end. 275 particles.
BODIES["block"] = """
[body]
problem = "three_dimensional"
spacing = 5
horizon_ratio = 2
[[regions]]
name = "block"
x = [0, 20]
y = [0, 50]
z = [0, 20]
[[regions]]
name = "lower grip"
x = [0, 20]
y = [0, 10]
z = [0, 20]
[[regions]]
name = "upper grip"
x = [0, 20]
y = [40, 50]
z = [0, 20]
[[regions]]
name = "lower end"
x = [0, 20]
y = [0, 0]
z = [0, 20]
[[regions]]
name = "upper end"
x = [0, 20]
y = [50, 50]
z = [0, 20]
[[materials]]
name = "concrete"
region = "block"
youngs_modulus = 30000
fracture_energy = 0.1
[[materials]]
name = "grips"
regions = ["lower grip", "upper grip"]
youngs_modulus = 30000
fracture_energy = "infinite"
[[cracks]]
corners = [[-1, 27, -1], [7, 27, -1], [7, 27, 21], [-1, 27, 21]]
[[supports]]
region = "lower end"
fix = ["x", "y", "z"]
[[displacements]]
region = "upper end"
x = 0
y = 0.1
z = 0
[stop]
broken_bonds = 100
[output]
fields_at = [40]
"""
