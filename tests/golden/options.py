"""Options that several golden cases share. Each changes the body that stands before it."""

OPTIONS = {}

# ------------------------------------------------------------------ how bonds soften and break

OPTIONS["linear"] = """
[[materials]] 1
tensile_strength = 3
softening = "linear"
softening_error = 0.05
"""
OPTIONS["bilinear"] = """
[[materials]] 1
tensile_strength = 3
softening_error = 0.05
"""
OPTIONS["exponential"] = """
[[materials]] 1
tensile_strength = 3
softening = "exponential"
softening_error = 0.05
"""
OPTIONS["open"] = """
[[materials]] 1
closing = false
"""
OPTIONS["closing"] = """
[[materials]] 1
closing = true
"""
OPTIONS["concrete_law"] = """
[[materials]] 1
fracture_energy
softening = "concrete"
softening_error = 0.1
tension_limit = 1.4e-4
tension_factor = 4
compression_limit = 1e-3
compression_factor = 3
"""
OPTIONS["weak_patch"] = """
[[materials]]
name = "weak"
region = "weak patch"
youngs_modulus = 30000
fracture_energy = 0.05
"""
OPTIONS["exact"] = """
[analysis]
event_tolerance = 0
"""
OPTIONS["wide_batches"] = """
[analysis]
event_tolerance = 0.05
"""

# ------------------------------------------------------------------ bodies

OPTIONS["micropolar"] = """
[body]
model = "micropolar"
[[materials]] 1
poissons_ratio = 0.2
[[materials]] 2
poissons_ratio = 0.2
"""
OPTIONS["hexagonal"] = """
[body]
pattern = "hexagonal"
"""
OPTIONS["uncalibrated"] = """
[body]
surface = "none"
micromodulus = "continuum"
critical_stretch = "continuum"
"""
# Particles of ghost bodies stand in the middle of their cells: grips are held, not lines.
OPTIONS["ghost"] = """
[body]
surface = "ghost"
[[supports]] 1
region = "lower grip"
[[supports]] 2
region = "upper grip"
[[displacements]] 1
region = "upper grip"
"""
OPTIONS["free_ends"] = """
-[[displacements]]
-[[supports]]
[[loads]]
region = "lower grip"
force = [0, -100]
[[loads]]
region = "upper grip"
force = [0, 100]
[analysis]
rigid_body_modes = "pin"
"""
OPTIONS["void"] = """
-[[cracks]]
[[regions]]
name = "window"
x = [0, 15]
y = [45, 60]
[[materials]] 1
holes = ["window"]
"""

# ------------------------------------------------------------------ loads and stages

OPTIONS["force"] = """
-[[displacements]]
[[loads]]
region = "load"
force = [0, -100]
"""
OPTIONS["reloaded"] = """
-[[displacements]]
-[stop]
[[loads]]
region = "body"
body_force = [0, -2.4e-5]
stage = "weight"
[[loads]]
region = "load"
force = [0, -100]
stage = "push"
[[stages]]
name = "weight"
to = 1
[[stages]]
name = "push"
load_fraction = 0.9
[[stages]]
name = "reverse"
loads = "push"
to = -1.2
[[stages]]
name = "reload"
loads = "push"
load_fraction = 0.7
"""
OPTIONS["regripped"] = """
-[stop]
[[loads]]
region = "body"
body_force = [0, -2.4e-5]
stage = "weight"
[[displacements]] 1
stage = "push"
[[stages]]
name = "weight"
to = 1
[[stages]]
name = "push"
load_fraction = 0.9
[[stages]]
name = "unload"
loads = "push"
to_load = 0
[[stages]]
name = "reverse"
loads = "push"
to_load = -120
[[stages]]
name = "reload"
loads = "push"
load_fraction = 0.7
"""
OPTIONS["steps"] = """
[analysis]
control = "steps"
"""

# ------------------------------------------------------------------ solvers

OPTIONS["iterative"] = """
[analysis]
solver = "iterative"
"""
OPTIONS["elastic"] = """
-[stop]
-[output]
[analysis]
type = "elastic"
"""

# ------------------------------------------------------------------ motion through time

OPTIONS["explicit"] = """
-[stop]
-[output]
[[materials]] 1
density = 2.4e-9
[[materials]] 2
density = 2.4e-9
[analysis]
type = "explicit"
duration = 0.001
ramp_time = 0.0008
damping_rate = 2000
rows = 100
[output]
fields_times = [0.0004]
"""
OPTIONS["relaxed"] = """
-[stop]
-[output]
[analysis]
type = "relaxation"
load_factors = [0.05, 0.1, 0.15]
tolerance = 1e-6
"""
OPTIONS["paper_2017"] = """
[body]
variant = "2017"
"""
OPTIONS["paper_2018"] = """
[body]
variant = "2018"
"""
OPTIONS["flow"] = """
[[materials]] 1
yield_strength = 22.98e6
ultimate_strength = 27.58e6
ultimate_plastic_strain = 0.003
[[displacements]] 1
y = -1.2e-3
"""
