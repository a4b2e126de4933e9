#include "specimen.hpp"

#include <algorithm>
#include <numbers>
#include <vector>

namespace perilink::verification {
namespace {

constexpr double spacing = 0.01, thickness = 0.15;

LatticeMaterial concrete(LatticeRules rules) {
  LatticeMaterial material;
  material.youngs_modulus = 25e9;
  material.poissons_ratio = 0.2;
  material.density = 2323.0;
  material.breakable = true;
  material.softening = {tension_strength, 0.25, 2e-5, 2e-4};
  material.internal_damping = material.external_damping = 0.2;
  material.fundamental_period = 0.00035;
  if (rules != LatticeRules::consistent) material.boundary_factor = 0.2;
  if (rules == LatticeRules::mean_2017) material.compressive_threshold = 1.0 / 3.0;
  return material;
}

class Silent final : public ExplicitObserver {
 public:
  void on_row(const ExplicitRecord& /*record*/, const ExplicitState& /*state*/) override {}
};

}  // namespace

ExplicitModel tension_specimen(LatticeRules rules, double degrees) {
  LatticeCut cut;
  cut.spacing = spacing;
  cut.rotation = degrees * std::numbers::pi / 180.0;
  cut.thickness = thickness;
  // The paper does not say how it cuts its lattices; this gives its numbers of particles.
  cut.upper = {0.075 + 0.26 * spacing, 0.15 + 1.58 * spacing, 0.0};
  cut.lower = {-cut.upper[0], -cut.upper[1], 0.0};
  cut.inside = [](const Vector3&) { return true; };
  ExplicitModel model = make_explicit_model(Problem::plane_stress, rules, hexagonal_rows(cut),
                                            concrete(rules), thickness);
  const LatticeRows& lattice = model.lattice;
  std::vector<PrescribedMotion> motions;
  double low = 0.0, high = 0.0;
  for (const Index slot : lattice.particle_slot) {
    low = std::min(low, lattice.positions[lattice.at(1, slot)]);
    high = std::max(high, lattice.positions[lattice.at(1, slot)]);
  }
  const double grip = 1.001 * spacing;
  for (const Index slot : lattice.particle_slot) {
    const double y = lattice.positions[lattice.at(1, slot)];
    if (y <= low + grip) motions.push_back({slot, 1, 0.0});
    if (y >= high - grip) motions.push_back({slot, 1, tension_drive});
  }
  prescribe(model, motions);
  return model;
}

TensionRun run_tension(LatticeRules rules, double degrees, double time_step, double duration) {
  const ExplicitModel model = tension_specimen(rules, degrees);
  ExplicitState state(model);
  ExplicitOptions options;
  options.duration = duration;
  options.ramp = 0.8 * duration;
  options.time_step = time_step;
  options.reference = tension_drive;
  Silent observer;
  TensionRun run;
  run.result = run_explicit_analysis(model, state, options, observer);
  run.particles = model.lattice.particles();
  run.fracture_energy = fracture_energy(model.material.softening);
  return run;
}

}  // namespace perilink::verification
