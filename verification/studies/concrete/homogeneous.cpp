#include "homogeneous.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include "analysis/quasistatic/damage_analysis.hpp"
#include "assembly/internal_force.hpp"
#include "io/case/case_file.hpp"
#include "law.hpp"
#include "model/from_case/configure.hpp"

namespace perilink::verification {
namespace {

constexpr double margin = 0.25 * side;  ///< what lies outside the inner part, more than a horizon

Model model_of(const Homogeneous& specimen) {
  const std::string text =
      fmt::format(R"([body]
problem = "plane_stress"
model = "micropolar"
{layout}
[[regions]]
name = "plate"
x = [0, {side}]
y = [0, {side}]
[[regions]]
name = "lower side"
x = [0, {side}]
y = [0, 0]
[[materials]]
region = "{material_region}"
{law}[[supports]]
region = "lower side"
fix = ["y"]
[[displacements]]
region = "body"
x = "{sign}x"
)",
                  fmt::arg("layout", specimen.layout), fmt::arg("side", side),
                  fmt::arg("material_region", "plate"),
                  fmt::arg("law", law_lines(specimen.shear_softens, specimen.error)),
                  fmt::arg("sign", specimen.compression ? "-" : ""));
  return build_model(parse_case(text, PERILINK_STUDY_DIR "/homogeneous.toml"));
}

/// Leaves one unknown: the motion of the upper side along y, which all particles share in, or, held
/// across, the rotation of the first particle, in a corner far from the inner part.
void carry_all(const Homogeneous& specimen, Model& model) {
  Unknowns& unknowns = model.unknowns;
  const Particles& particles = model.network.particles;
  const auto width = static_cast<std::size_t>(unknowns.width);
  std::fill(unknowns.number.begin(), unknowns.number.end(), no_index);
  unknowns.count = 1;
  if (specimen.held_across) {
    unknowns.number[width - 1] = 0;
    return;
  }
  for (std::size_t i = 0; i < static_cast<std::size_t>(particles.size()); ++i) {
    const double y = particles.positions[2 * i + 1];
    const Unknowns::Share share{0, y / side};
    if (y > 1e-9 * side) unknowns.carry(width * i + 1, {&share, 1});
  }
}

/// Elements with both ends in the inner part, and those with one.
std::array<std::vector<Index>, 2> inner_elements(const Network& network) {
  const auto is_inner = [&](Index i) {
    const double x = network.particles.positions[2 * i], y = network.particles.positions[2 * i + 1];
    return x > margin && x < side - margin && y > margin && y < side - margin;
  };
  std::array<std::vector<Index>, 2> found;
  for (Index e = 0; e < network.num_elements(); ++e) {
    const int ends = is_inner(network.bonds.first[e]) + is_inner(network.bonds.second[e]);
    if (ends > 0) found[static_cast<std::size_t>(2 - ends)].push_back(e);
  }
  return found;
}

class StressRecorder final : public StepObserver {
 public:
  explicit StressRecorder(const Network& network) : inner_(inner_elements(network)) {
    for (Index i = 0; i < network.particles.size(); ++i) {
      const double x = network.particles.positions[2 * i];
      const double y = network.particles.positions[2 * i + 1];
      if (x > margin && x < side - margin && y > margin && y < side - margin) {
        volume_ += network.particles.volumes[i];
      }
    }
  }
  void on_step(const StepRecord& row, StateSource& source) override {
    const StepState state = source.state();
    const Network& network = state.network;
    const auto width = static_cast<std::size_t>(network.width());
    std::array<double, 2> stress{};
    double across = 0.0;
    for (std::size_t part = 0; part < 2; ++part) {
      internal_force(network, state.secants, state.displacement, inner_[part], forces_);
      for (std::size_t i = 0; i < static_cast<std::size_t>(network.particles.size()); ++i) {
        for (std::size_t axis = 0; axis < 2; ++axis) {
          // A bond that leaves the inner part belongs to it by half.
          stress[axis] += row.load_factor * forces_.forces[width * i + axis] *
                          network.particles.positions[2 * i + axis] / (part == 0 ? 1.0 : 2.0) /
                          volume_;
        }
        const double y = network.particles.positions[2 * i + 1];
        if (y > side * (1.0 - 1e-9)) across = state.displacement[width * i + 1] / side;
      }
    }
    points.push_back({row.load_factor, row.load_factor * across, stress[0], stress[1]});
  }
  std::vector<HomogeneousPoint> points;

 private:
  std::array<std::vector<Index>, 2> inner_;
  double volume_ = 0.0;
  InternalForce forces_;
};

}  // namespace

std::vector<ReferenceCurve> read_reference() {
  std::ifstream file(PERILINK_STUDY_DIR "/reference.csv");
  std::vector<ReferenceCurve> curves;
  std::string line, begun;
  std::getline(file, line);
  while (std::getline(file, line)) {
    std::replace(line.begin(), line.end(), ',', ' ');
    std::istringstream fields(line);
    std::string rule, across;
    HomogeneousPoint point;
    fields >> rule >> across >> point.strain >> point.strain_across >> point.stress >>
        point.stress_across;
    if (!fields) throw std::runtime_error("reference.csv: " + line);
    const std::string key = rule + across + (point.strain < 0.0 ? "-" : "+");
    if (key != begun) curves.push_back({rule == "B", across == "held", {}});
    begun = key;
    curves.back().points.push_back(point);
  }
  return curves;
}

std::vector<HomogeneousPoint> strain_uniformly(const Homogeneous& specimen) {
  Model model = model_of(specimen);
  carry_all(specimen, model);
  StressRecorder recorder(model.network);
  DamageOptions options;
  options.load_factors = specimen.strains;
  run_damage_analysis(model, options, recorder);
  return recorder.points;
}

}  // namespace perilink::verification
