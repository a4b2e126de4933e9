#include "cracks.hpp"

#include <algorithm>
#include <cmath>

#include "app/plot/plot_curve.hpp"
#include "base/timer.hpp"
#include "io/case/case_file.hpp"
#include "results/field_file.hpp"

namespace perilink::verification {
namespace {

/// Keeps the bonds in the order of breaking, the energy of each moment and the body at the end.
class CrackRecorder final : public StepObserver {
 public:
  explicit CrackRecorder(const Model& model) : model_(model) {}

  void on_step(const StepRecord& record, StateSource& /*source*/) override {
    rows.push_back(record);
    if (record.element != no_index) bonds_.push_back(record.element);
  }

  void on_end(const StepRecord& last, StateSource& source) override {
    const Network& network = model_.network;
    const StepState state = source.state();
    std::vector<double> motion(state.displacement.begin(), state.displacement.end());
    for (double& u : motion) u *= last.load_factor;
    const FieldMoment moment{last.step, last.broken_bonds, last.load_factor, last.load,
                             model_.lattice.spacing};
    body =
        read_body(make_field_grid(network, state.secants, motion, moment, broken(last.broken_bonds),
                                  bonds_of_particles(network.bonds, network.particles.size())),
                  "field");
  }

  std::span<const Index> broken(Index count) const {
    return std::span<const Index>(bonds_).first(static_cast<std::size_t>(count));
  }

  std::vector<StepRecord> rows;
  PlotBody body;

 private:
  const Model& model_;
  std::vector<Index> bonds_;
};

constexpr std::size_t growth_points = 40;

std::vector<GrowthPoint> growth_of(const Specimen& specimen, const Model& model,
                                   const CrackRecorder& recorder) {
  std::vector<GrowthPoint> growth;
  for (std::size_t k = 1; k <= growth_points; ++k) {
    const StepRecord& row = recorder.rows[(recorder.rows.size() - 1) * k / growth_points];
    const CrackPath path = find_crack(specimen, model, recorder.broken(row.broken_bonds));
    growth.push_back({path.energy, row.dissipated_energy});
  }
  return growth;
}

/// Slope of the straight line through the points at a quarter to three quarters of the crack's
/// energy.
double slope_of(const std::vector<GrowthPoint>& growth) {
  const double whole = growth.back().crack_energy;
  double n = 0.0, x = 0.0, y = 0.0, xx = 0.0, xy = 0.0;
  for (const GrowthPoint& point : growth) {
    if (point.crack_energy < 0.25 * whole || point.crack_energy > 0.75 * whole) continue;
    n += 1.0;
    x += point.crack_energy;
    y += point.dissipated;
    xx += point.crack_energy * point.crack_energy;
    xy += point.crack_energy * point.dissipated;
  }
  return (n * xy - x * y) / (n * xx - x * x);
}

/// Bonds that a plane crack breaks per horizon.
std::size_t bonds_per_horizon(const Lattice& lattice, double horizon, int across) {
  double rows = 0.0;
  for (const Vector3& xi : interior_neighbourhood(lattice, horizon).offsets) {
    rows += std::max(xi[across], 0.0) / lattice.spacing;
  }
  return static_cast<std::size_t>(std::lround(rows * horizon / lattice.spacing));
}

double smooth_peak_of(const std::vector<StepRecord>& rows, std::size_t window) {
  double peak = 0.0;
  for (const CurvePoint& point : smooth_envelope(event_path(rows), window)) {
    peak = std::max(peak, point.load);
  }
  return peak;
}

std::optional<double> reference_load(const Specimen& specimen, const Model& model,
                                     const CaseFile& input) {
  if (specimen.shape != Shape::block) return specimen.griffith_load;
  const std::vector<double>& stretches = model.network.critical_stretch;
  return *std::min_element(stretches.begin(), stretches.end()) * input.materials[0].youngs_modulus *
         specimen.thickness * (specimen.ligament[1] - specimen.ligament[0]);
}

}  // namespace

CrackRun run_specimen(const Specimen& specimen, int threads) {
  const CaseFile input = parse_case(specimen.text, specimen.name);
  const Model model = build_model(input);
  CrackRecorder recorder(model);
  CrackRun run;
  run.specimen = specimen;
  const Timer timer;
  run.result = run_damage_analysis(model, damage_options(input, threads), recorder);
  run.seconds = timer.seconds();
  const std::span<const Index> broken = recorder.broken(run.result.last.broken_bonds);
  run.path = find_crack(specimen, model, broken);
  run.stray = find_stray_breaks(specimen, run.path, model, broken);
  run.smooth_peak = smooth_peak_of(
      recorder.rows, bonds_per_horizon(model.lattice, model.horizon, 1 - specimen.along));
  run.reference_load = reference_load(specimen, model, input);
  run.first_load = recorder.rows.front().load;
  run.plane_ratio = plane_crack_energy_ratio(specimen, model);
  run.growth = growth_of(specimen, model, recorder);
  run.growth_ratio = slope_of(run.growth);
  run.body = std::move(recorder.body);
  return run;
}

}  // namespace perilink::verification
