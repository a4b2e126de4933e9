#include "measures.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/error.hpp"
#include "base/timer.hpp"
#include "model/from_case/configure.hpp"
#include "studies/toughness/bodies.hpp"

namespace perilink::verification {
namespace {

class Recorder final : public StepObserver {
 public:
  void on_step(const StepRecord&, StateSource&) override { ++events; }
  void on_end(const StepRecord&, StateSource& source) override {
    const StepState state = source.state();
    const Network& network = state.network;
    for (Index b = 0; b < network.bonds.size(); ++b) {
      if (state.secants[b] > 0.0 || network.is_contact(b)) continue;
      const auto x = network.particles.position(network.bonds.first[b]);
      const auto y = network.particles.position(network.bonds.second[b]);
      broken.push_back({0.5 * (x[0] + y[0]), 0.5 * (x[1] + y[1])});
    }
  }
  int events = 0;
  std::vector<Place> broken;
};

}  // namespace

Crack run_specimen(const Specimen& specimen) {
  const CaseFile input = parse_case(specimen.text, "specimen.toml");
  const Timer timer;
  const Model model = build_model(input);
  const double set_up = timer.seconds();
  Recorder recorder;
  const DamageResult result = run_damage_analysis(model, damage_options(input, 1), recorder);
  if (result.termination == Termination::failed) throw SolverError(result.reason);
  return {std::abs(result.peak_load),
          std::abs(result.smoothed_peak_load.value_or(0.0)),
          result.energy_error,
          static_cast<int>(model.unknowns.count),
          recorder.events,
          model.horizon,
          std::move(recorder.broken),
          set_up,
          timer.seconds() - set_up};
}

Direction direction_of(const Crack& crack, const Place& tip, double horizons) {
  double n = 0.0, x = 0.0, y = 0.0, xx = 0.0, xy = 0.0, yy = 0.0;
  for (const Place& place : crack.broken) {
    const double dx = place[0] - tip[0], dy = place[1] - tip[1], r = std::hypot(dx, dy);
    if (r < crack.horizon || r > horizons * crack.horizon) continue;
    n += 1.0;
    x += dx;
    y += dy;
    xx += dx * dx;
    xy += dx * dy;
    yy += dy * dy;
  }
  if (n < 3.0) return {std::nan(""), std::nan("")};
  double angle = 0.5 * std::atan2(2.0 * xy, xx - yy);
  if (std::cos(angle) * x + std::sin(angle) * y < 0.0) angle += std::numbers::pi;
  const double across = 0.5 * (xx + yy - std::hypot(xx - yy, 2.0 * xy)) / n;
  return {std::remainder(angle, 2.0 * std::numbers::pi) * 180.0 / std::numbers::pi,
          std::sqrt(std::max(across, 0.0)) / crack.horizon};
}

StripEnergy energy_of_strip(const Make& make) {
  const auto [first, second, third] = tips_of_strip(make);
  const PathEnergy energy =
      measure_case([&](double tip) { return clamped_strip(make, tip); }, first, second, third);
  return {energy.dissipated / fracture_energy, energy.events};
}

}  // namespace perilink::verification
