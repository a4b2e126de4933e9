"""The table of small golden cases, continued: space, meshes, thin bodies, motion through time."""

from cases import CASES, case

# ------------------------------------------------------------------ bars in space

case("block_brittle", "block", "", "broken")
case("block_softening_batches", "block", "bilinear", "yield batches", """
[stop]
broken_bonds = 20
""")
case("block_iterative_softening_batches", "block", "linear iterative", "yield batches", """
[[cracks]] 1
closing = false
[stop]
displacement = 0.01
""")
case("block_micropolar_torsion", "block", "micropolar linear", "yield batches", """
[body]
torsion = 0.5
[stop]
displacement = 0.015
""")
case("block_face_centred_steps", "block", "steps", "broken", """
[body]
pattern = "face_centred"
horizon_ratio = 1.8
-[stop]
[analysis]
load_factors = [0.1, 0.2, 0.25]
""")
case("block_closing_stages", "block", "linear", "yield stages side_change", """
[[displacements]] 1
stage = "pull"
-[stop]
[[stages]]
name = "pull"
broken_bonds = 20
[[stages]]
name = "press"
loads = "pull"
to_load = -2000
""")
case("block_bars", "block", "", "broken bars", """
[[rebar]]
inside = "block"
along = "y"
face = "-x"
cover = 6
number = 2
youngs_modulus = 200000
area = 5
yield_strength = 400
bond = "concrete"
""")
case("block_bar_slip_yield_exact", "block", "exact", "yield bars", """
[[rebar]]
from = [10, 2, 10]
to = [10, 48, 10]
youngs_modulus = 200000
area = 10
yield_strength = 200
bond = "model_code"
concrete_strength = 38
rib_spacing = 4
bond_failure = "splitting"
[stop]
broken_bonds = 200
""")
case("block_void_plane_forces", "block", "", "broken", """
-[[cracks]]
[[regions]]
name = "window"
x = [0, 10]
y = [20, 30]
z = [0, 20]
[[materials]] 1
holes = ["window"]
-[[displacements]]
[[tractions]]
region = "upper end"
traction = [0, 1, 0]
[body]
surface = "energy"
""")
case("block_elements_release", "block", "", "release", """
[elements]
spacings = 2
[stop]
broken_bonds = 30
""")
case("block_interface", "block", "", "broken", """
-[[cracks]]
[[interfaces]]
corners = [[-1, 27, -1], [21, 27, -1], [21, 27, 21], [-1, 27, 21]]
fracture_energy = 0.02
""")
case("block_iterative_subdomains", "block", "elastic iterative", "", """
[body]
spacing = 2.5
[analysis]
coarse_box = 4
tolerance = 1e-9
""")

# ------------------------------------------------------------------ meshes

case("plate_brittle", "plate", "", "broken")
case("plate_softening", "plate", "linear", "yield batches", """
[[materials]] 1
tensile_strength = 60
[stop]
broken_bonds = 20
""")
case("plate_crack_closing_springs", "plate", "closing", "broken", """
[[cracks]]
points = [[2, 1], [2, 2]]
-[[supports]]
[[supports]]
region = "left side"
fix = ["x"]
[[springs]]
region = "bottom"
total = [0, 5000]
""")
case("plate_interface", "plate", "", "broken", """
[[interfaces]]
points = [[2, -1], [2, 4]]
fracture_energy = 0.01
[stop]
broken_bonds = 60
""")
case("plate_micropolar", "plate", "", "broken", """
[body]
model = "micropolar"
[[materials]] 1
poissons_ratio = 0.2
[stop]
broken_bonds = 30
""")
case("plate_tied_elements", "plate", "", "broken", """
[elements]
glued = ["far"]
[stop]
broken_bonds = 40
""")
case("plate_elements_of_mesh", "plate", "elastic", "", """
[elements]
mesh = "meshes/plate_with_hole.geo"
mesh_size = 1.2
""")
case("plate_geometry", "plate", "", "broken", """
[body]
mesh = "meshes/plate_with_hole.geo"
mesh_size = 0.5
surface = "none"
[stop]
broken_bonds = 30
""")
case("plate_linear_elements", "plate", "elastic", "", """
[body]
method = "linear_elements"
horizon_ratio
""")
case("sphere_calibrated", "sphere", "", "", """
[body]
horizon_ratio = 3
""")
case("sphere_iterative", "sphere", "iterative", "", """
[body]
surface = "energy"
""")
case("sphere_micropolar", "sphere", "", "", """
[body]
model = "micropolar"
surface = "energy"
[[materials]] 1
poissons_ratio = 0.15
""")
case("pierced_breaking_uncalibrated", "pierced", "", "broken", """
[body]
surface = "none"
[stop]
broken_bonds = 10
""")

# ------------------------------------------------------------------ shells and beams

SOFT = """
[[materials]] 1
softening_error = 0.05
softening = "linear"
tensile_strength =""".rstrip()
case("shell_clamped_brittle", "clamped_plate", "", "broken")
case("shell_clamped_softening", "clamped_plate", "", "yield batches", SOFT + """ 4
[stop]
broken_bonds = 5
""")
case("shell_roof_elastic", "roof")
case("shell_disc_of_mesh", "roof", "", "broken", """
[body]
radius
columns
mesh = "meshes/disc.msh"
[[regions]] 1
x
y
group = "disc"
[[regions]] 2
x
y
group = "rim"
[[materials]] 1
fracture_energy = 0.01
-[[symmetry]]
-[analysis]
[stop]
broken_bonds = 30
[[supports]] 1
fix = ["x", "y", "z"]
""")
case("line_beam_brittle", "timber", "", "broken", """
[body]
horizon_ratio = 3
""")
case("line_beam_softening", "timber", "wide_batches", "yield batches", SOFT + """ 40
softening_error = 0.01
[body]
horizon_ratio = 2
""")
case("line_beam_elements", "timber", "", "broken release", """
[body]
horizon_ratio = 2
[elements]
spacings = 4
particles = ["left end"]
""")

# ------------------------------------------------------------------ explicit bonds and relaxation

case("explicit_brittle", "strip", "explicit", "broken")
case("explicit_uniform_masses_softening", "strip", "explicit bilinear hexagonal", "dissipated", """
[analysis]
masses = "uniform"
""")
case("explicit_green_velocities", "strip", "explicit", "broken", """
-[[displacements]]
[[velocities]]
region = "upper end"
y = 100
[analysis]
strain = "green"
""")
case("explicit_micropolar_closing", "beam", "explicit micropolar linear closing", "dissipated", """
-[[gauges]]
[[displacements]] 1
y = -0.05
""")
case("explicit_bars_force", "reinforced", "explicit", "bars", """
[[rebar]]
from = [-115, 7]
to = [115, 7]
youngs_modulus = 200000
area = 50
bond = "concrete"
-[[displacements]]
[[loads]]
region = "load"
force = [0, -2000]
""")
case("explicit_block", "block", "explicit", "broken", """
[analysis]
duration = 0.0005
ramp_time = 0.0004
[output]
fields_times = [0.0002]
""")
case("relaxed_brittle", "strip", "relaxed", "broken", """
[analysis]
load_factors = [0.1, 0.2, 0.26]
""")
case("relaxed_green", "beam", "relaxed", "", """
-[[gauges]]
[analysis]
strain = "green"
load_factors = [0.02, 0.04]
tolerance = 1e-5
""")

# ------------------------------------------------------------------ state-based particles

case("lattice_consistent", "lattice", "", "cracked")
case("lattice_2017", "lattice", "paper_2017", "cracked")
case("lattice_2018", "lattice", "paper_2018", "cracked")
case("lattice_2018_flow", "lattice", "paper_2018 flow", "plastic")
case("lattice_crushing_rotated", "lattice", "flow", "plastic", """
[body]
rotation = 15
offset = [0.005, 0]
[[materials]] 1
crushing_energy = 4.62e4
""")
case("lattice_hole_stress_elastic", "lattice", "", "", """
-[analysis]
-[output]
[[materials]] 1
holes = ["hole"]
[[supports]] 1
fix = ["x", "y"]
[analysis]
type = "elastic"
[[gauges]]
name = "beside_hole"
at = [0.06, 0]
stress = "yy"
""")
case("lattice_bar_cracking", "lattice_bar", "", "cracked")
case("lattice_bar_flow_2017", "lattice_bar", "paper_2017", "plastic", """
[[materials]] 1
yield_strength = 0.8
ultimate_strength = 1
ultimate_plastic_strain = 0.01
tensile_strength = 100
""")
case("particles_mesh_cracking", "particles", "", "cracked")
case("particles_elastic", "particles", "", "", """
-[output]
-[analysis]
[analysis]
type = "elastic"
""")
case("particles_lattice_in_space", "lattice_bar", "", "", """
[body]
model = "particles"
[[materials]] 1
fracture_energy = "infinite"
tensile_strength
critical_opening
""")

__all__ = ["CASES"]
