#include "stability.hpp"

#include <fmt/format.h>

#include <cmath>

#include "analysis/dynamics/bonds/runs/bond_analysis.hpp"
#include "app/run/bond_run.hpp"
#include "model/from_case/lattice_case.hpp"

namespace perilink::verification {
namespace {

constexpr double steps = 20000.0;

std::string case_text(const MovingBody& body) {
  const bool lattice = body.name == "lattice", moments = body.name == "frame";
  std::string text = lattice ? "[body]\nmodel = \"lattice\"\nspacing = 0.05\nrotation = 15\n"
                             : "[body]\nspacing = 0.05\nhorizon_ratio = 3\nsurface = \"none\"\n";
  if (moments) text += "model = \"micropolar\"\n";
  text += R"([[regions]]
name = "block"
x = [0, 1]
y = [0, 1]
[[regions]]
name = "bottom"
x = [0, 1]
y = [0, 0.06]
[[regions]]
name = "top"
x = [0, 1]
y = [0.94, 1]
[[materials]]
region = "block"
youngs_modulus = 30
density = 2.5
)";
  if (lattice || moments) text += "poissons_ratio = 0.2\n";
  if (lattice && body.cracks) text += "tensile_strength = 0.03\n";
  text += body.cracks ? "fracture_energy = 2e-5\n" : "fracture_energy = \"infinite\"\n";
  text += R"([[supports]]
region = "bottom"
fix = ["x", "y"]
[[displacements]]
region = "top"
y = 0.02
[analysis]
type = "explicit"
duration = 4
ramp_time = 2
)";
  if (body.name == "Green") text += "strain = \"green\"\n";
  return text;
}

/// As many steps whatever their length; only the load's speed changes with it.
void choose(ExplicitOptions& options, double critical, double factor, bool refuse) {
  options.time_step = factor * critical;
  options.duration = steps * options.time_step;
  options.ramp = 0.25 * options.duration;
  options.refuse_unstable = refuse;
  options.rows = 100;
}

}  // namespace

std::vector<MovingBody> moving_bodies() {
  std::vector<MovingBody> bodies;
  for (const char* name : {"truss", "frame", "Green", "lattice"}) {
    for (const bool cracks : {false, true}) bodies.push_back({name, cracks});
  }
  return bodies;
}

ExplicitResult run_at(const MovingBody& body, double factor, bool refuse) {
  const CaseFile input = parse_case(case_text(body), body.name);
  if (body.name == "lattice") {
    ExplicitCase built = build_explicit_case(input);
    choose(built.options, built.critical_time_step, factor, refuse);
    ExplicitState state(built.model);
    ExplicitObserver observer;
    return run_explicit_analysis(built.model, state, built.options, observer);
  }
  const Model model = build_model(input);
  BondRunCase built = build_bond_run(input, model);
  choose(built.options, built.inertia.critical_time_step(), factor, refuse);
  BondRunObserver observer;
  return run_explicit_bonds(model, built.inertia, built.rules, built.options, observer);
}

bool is_finite(const ExplicitRecord& record) {
  const EnergyBalance& energy = record.energy;
  return std::isfinite(energy.kinetic + energy.stored + energy.fractured + energy.external_work +
                       record.load + record.support_reaction + record.displacement);
}

}  // namespace perilink::verification
