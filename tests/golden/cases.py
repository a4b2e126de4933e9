"""The table of small golden cases: name, body, options, what the results must show.

The words of `shows` are explained in results.py.
"""

CASES = []


def case(name, body, options="", shows="", more=""):
    """Adds a case. options: names of options.py, in their order; more: changes of its own."""
    CASES.append((name, body, options.split(), shows.split(), more))


# ------------------------------------------------------------------ strips in the plane

case("strip_brittle", "strip", "weak_patch", "broken")
case("strip_brittle_hexagonal_strain", "strip", "hexagonal", "broken", """
[body]
problem = "plane_strain"
""")
case("strip_ghost_driven", "strip", "ghost weak_patch", "broken", """
[body]
horizon_ratio
horizon_level = 4
""")
case("strip_ghost_pinned_forces", "strip", "ghost free_ends", "broken", """
[body]
critical_stretch = "lattice"
""")
case("strip_uncalibrated", "strip", "uncalibrated", "broken")
case("strip_energy_surface_lattice_stretch", "strip", "", "broken", """
[body]
surface = "energy"
critical_stretch = "lattice"
""")
case("strip_void_closing", "strip", "void closing", "broken")
case("strip_layers_of_two_moduli", "strip", "", "broken", """
[[regions]]
name = "upper half"
x = [0, 50]
y = [50, 100]
[[materials]]
region = "upper half"
youngs_modulus = 10000
fracture_energy = 0.08
[[materials]] 2
regions = ["lower grip"]
[[materials]]
regions = ["upper grip"]
youngs_modulus = 10000
fracture_energy = "infinite"
""")
case("strip_random_strength_and_energy", "strip", "linear", "yield", """
[[random]]
property = "tensile_strength"
distribution = "weibull"
variation = 0.1
correlation_length = 30
[[random]]
property = "fracture_energy"
distribution = "lognormal"
variation = 0.1
correlation_length = 30
seed = 2
""")
case("strip_random_closing", "strip", "closing", "broken", """
[[random]]
property = "fracture_energy"
distribution = "normal"
variation = 0.1
correlation_length = 30
""")
case("strip_graded", "strip", "linear", "yield", """
[[graded]]
property = "youngs_modulus"
factor = "1 + x / 100"
[[graded]]
property = "tensile_strength"
factor = "1 + (y - 40)^2 / 5000"
""")
case("strip_graded_elastic", "strip", "micropolar elastic", "", """
[[graded]]
property = "youngs_modulus"
factor = "1 + x * y / 5000"
[[random]]
property = "youngs_modulus"
distribution = "lognormal"
variation = 0.2
correlation_length = 30
""")
case("strip_steps_driven", "strip", "steps", "broken", """
-[stop]
[analysis]
load_factors = [0.1, 0.2, 0.3, 0.4]
""")
case("strip_steps_force_softening", "strip", "free_ends steps linear", "yield", """
-[stop]
[analysis]
load_factors = [2, 5, 7, 8]
""")
case("strip_refactorized", "strip", "weak_patch", "broken", """
[analysis]
factor = "refactorize"
""")
case("strip_cholmod_updown", "strip", "bilinear exact", "yield", """
[analysis]
factor = "cholmod_updown"
[stop]
broken_bonds = 10
""")
case("strip_iterative_brittle", "strip", "iterative", "broken")
case("strip_iterative_softening_batches", "strip", "exponential iterative", "yield batches", """
[[cracks]] 1
closing = false
[stop]
displacement = 0.008
""")
case("strip_iterative_micropolar", "strip", "micropolar iterative", "broken", """
[stop]
broken_bonds = 20
""")
case("strip_micropolar_turned", "strip", "micropolar", "broken", """
[[supports]] 1
fix = ["x", "y", "rotation"]
-[[displacements]]
[[supports]] 2
region = "lower end"
[[displacements]]
region = "upper end"
x = "-0.01*(y - 100)"
y = "0.01*(x - 25) + 0.01"
rotation = 0.01
""")
case("strip_formulas_springs_elastic", "strip", "elastic", "", """
-[[displacements]]
-[[supports]]
[[springs]]
region = "lower end"
stiffness = [20, "50"]
[[loads]]
region = "body"
body_force = ["1e-3*sin(y/50)", "-2.4e-5"]
[[tractions]]
region = "upper end"
traction = ["0", "1 + 0.01*x"]
[[point_loads]]
at = [50, 50]
force = [5, 0]
""".replace('"50"', "50"))

# ------------------------------------------------------------------ notched beams

case("beam_brittle_hexagonal", "beam", "hexagonal", "broken", """
[[supports]] 1
fix = ["x", "y"]
[[cracks]] 1
points = [[1, -1], [1, 10]]
""")
case("beam_softening_exact", "beam", "linear exact", "yield", """
[stop]
load_fraction = 0.8
""")
case("beam_softening_batches", "beam", "bilinear", "yield batches")
case("beam_softening_batches_open", "beam", "exponential open wide_batches", "yield batches")
case("beam_softening_closing_stages", "beam", "linear reloaded",
     "yield batches side_change stages")
case("beam_softening_closing_stages_exact", "beam", "linear reloaded exact",
     "yield side_change stages", """
[[stages]] 2
load_fraction = 0.97
[[stages]] 4
load_fraction = 0.9
""")
case("beam_softening_regripped", "beam", "bilinear regripped", "yield side_change stages")
case("beam_brittle_reloaded", "beam", "reloaded", "broken stages")
case("beam_brittle_closing_regripped", "beam", "closing regripped", "broken stages")
case("beam_avalanches", "beam", "force", "broken avalanche stages", """
-[stop]
[[stages]]
name = "half"
to = 2
[[stages]]
name = "push"
loads = "half"
to = 5.2
""")
case("beam_softening_avalanche", "beam", "linear force", "yield avalanche stages", """
-[stop]
[[loads]]
region = "body"
body_force = [0, -2.4e-5]
stage = "weight"
[[loads]] 1
stage = "push"
[[stages]]
name = "weight"
to = 1
[[stages]]
name = "push"
to = 1.66
""")
case("beam_force_snap_back", "beam", "force", "broken")
case("beam_half_on_springs", "beam", "bilinear", "yield", """
[[regions]]
name = "plane"
x = [0, 0]
y = [12, 30]
[[regions]]
name = "foot"
x = [54, 60]
y = [0, 0]
[[regions]] 1
x = [0, 60]
[[materials]] 2
regions = ["right end"]
-[[cracks]]
-[[gauges]]
-[[supports]]
[[symmetry]]
region = "plane"
axis = "x"
[[springs]]
region = "foot"
stiffness = [0, 1000]
[[gauges]]
name = "foot"
region = "foot"
axis = "y"
""")
case("beam_micropolar_softening", "beam", "micropolar linear", "yield batches")
case("beam_micropolar_closing_stages", "beam", "micropolar bilinear reloaded",
     "yield side_change stages")
case("beam_micropolar_concrete", "beam", "micropolar concrete_law", "yield", """
[stop]
load_fraction = 0.8
""")
case("beam_micropolar_concrete_shear_exact", "beam", "micropolar concrete_law exact", "yield", """
[[materials]] 1
shear_softening = true
[stop]
load_fraction = 0.95
""")

# ------------------------------------------------------------------ elements

case("beam_elements_release", "beam", "", "release", """
[elements]
spacings = 4
""")
case("beam_elements_softening_stages", "beam", "linear reloaded", "release freed yield stages", """
[elements]
spacings = 4
particles = ["load"]
""")
# Tests of embedded particles have the same beam: an alert as late as this misses a bond.
case("beam_elements_missed_release", "beam", "force", "missed", """
[body]
spacing = 2
[[regions]] 1
x = [-80, 80]
y = [0, 40]
[[regions]] 2
x = [-80, -20]
y = [0, 40]
[[regions]] 3
x = [20, 80]
y = [0, 40]
[[regions]] 4
x = [-70, -66]
[[regions]] 5
x = [66, 70]
[[regions]] 6
x = [-2, 2]
y = [40, 40]
[[regions]]
name = "top"
x = [-20, 20]
y = [32, 40]
[[materials]] 2
regions = ["left end", "right end", "top"]
[[cracks]] 1
points = [[1, -1], [1, 13]]
-[[gauges]]
-[stop]
[stop]
broken_bonds = 120
[elements]
spacings = 4
alert = 0.99
halo = 0.01
""")
case("beam_elements_alert_strain_linear", "beam", "hexagonal", "release", """
[elements]
size = 10
order = 1
alert_strain = 2e-5
halo = 5
[[cracks]] 1
points = [[1, -1], [1, 10]]
""")
case("beam_linear_elements", "beam", "elastic", "", """
[body]
method = "linear_elements"
horizon_ratio
-[[cracks]]
-[[gauges]]
[[materials]] 1
poissons_ratio = 0.3
[[materials]] 2
poissons_ratio = 0.3
""")

# ------------------------------------------------------------------ bars

BAR = """
[[rebar]]
from = [-115, 7]
to = [115, 7]
youngs_modulus = 200000
area = 50
yield_strength = 500
"""
case("bar_perfect_yielding", "reinforced", "", "broken yield bars", BAR + """
area = 15
yield_strength = 300
[stop]
broken_bonds = 400
""")
case("bar_model_code_yielding", "reinforced", "bilinear", "yield bars", BAR + """
bond = "model_code"
concrete_strength = 38
rib_spacing = 8
area = 20
yield_strength = 300
hooks = "both"
""")
case("bar_concrete_bonds", "reinforced", "", "broken bars", BAR + """
bond = "concrete"
ties_break = false
""")
case("bar_prestressed_stages", "reinforced", "", "broken bars stages", BAR + """
prestrain = 0.001
stage = "prestress"
[[displacements]] 1
stage = "push"
-[stop]
[[stages]]
name = "prestress"
to = 1
[[stages]]
name = "push"
broken_bonds = 80
""")
case("bar_curve_stirrups", "reinforced", "", "broken bars", BAR + """
bond = "curve"
bond_curve = [[0.01, 3], [0.5, 8], [5, 2]]
[[rebar]]
inside = "beam"
along = "x"
cover = 5
spacing = 40
youngs_modulus = 200000
area = 20
bond = "linear"
bond_stiffness = 50
bond_strength = 8
""")
case("bar_hardening_rupture_exact", "reinforced", "linear exact", "yield bars", BAR + """
area = 5
yield_strength = 300
hardening_modulus = 2000
rupture_strain = 0.01
[stop]
broken_bonds = 3
""")

# ------------------------------------------------------------------ interfaces

case("joint_brittle", "joint", "", "broken")
case("joint_linear_batches", "joint", "", "yield batches", """
[[interfaces]] 1
tensile_strength = 6
softening = "linear"
softening_error = 0.05
""")
case("joint_closing_stages", "joint", "", "yield stages", """
[[interfaces]] 1
tensile_strength = 6
softening_error = 0.05
[[displacements]] 1
stage = "peel"
[[displacements]] 2
stage = "peel"
-[stop]
[[stages]]
name = "peel"
broken_bonds = 30
[[stages]]
name = "back"
loads = "peel"
to_load = 0
[[stages]]
name = "again"
loads = "peel"
broken_bonds = 60
""")
case("joint_micropolar_two_moduli", "joint", "micropolar", "broken", """
[[materials]] 2
youngs_modulus = 10000
""")
