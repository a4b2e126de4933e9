#include "specimens.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "model/from_case/configure.hpp"

namespace perilink::verification {
namespace {

constexpr double youngs_modulus = 30000.0, poissons_ratio = 0.2;
constexpr double strip_width = 50.0, bar_width = 40.0;  // [mm]

bool in_space(const Make& make) { return make.pattern == "cubic"; }

std::string region(const std::string& name, double x0, double x1, double y0, double y1, double z1) {
  return fmt::format("[[regions]]\nname = \"{}\"\nx = [{}, {}]\ny = [{}, {}]\n", name, x0, x1, y0,
                     y1) +
         (z1 > 0.0 ? fmt::format("z = [0, {}]\n", z1) : "");
}

std::string body(const Make& make, const std::string& mesh) {
  if (make.pattern == "mesh") {
    return fmt::format(
        "[body]\nmodel = \"{}\"\nmesh = \"{}\"\nmesh_size = {}\nhorizon_ratio = {}\n", make.model,
        mesh, make.spacing, make.horizon_ratio);
  }
  return fmt::format(
      "[body]\nproblem = \"{}\"\nmodel = \"{}\"\npattern = \"{}\"\nspacing = {}\n"
      "horizon_ratio = {}\n",
      in_space(make) ? "three_dimensional" : "plane_stress", make.model, make.pattern, make.spacing,
      make.horizon_ratio);
}

std::string materials(const Make& make, const std::string& whole, const std::string& unbreakable) {
  std::string elastic = fmt::format("youngs_modulus = {}\n", youngs_modulus);
  if (make.model == "micropolar") elastic += fmt::format("poissons_ratio = {}\n", poissons_ratio);
  std::string law = make.softening == "brittle"
                        ? ""
                        : fmt::format("tensile_strength = {}\nsoftening = \"{}\"\n",
                                      tensile_strength, make.softening);
  if (make.softening == "bilinear") {
    law += fmt::format("knee_stress_ratio = {}\nknee_opening_ratio = {}\n", make.knee_stress_ratio,
                       make.knee_opening_ratio);
  }
  return fmt::format("[[materials]]\nregion = \"{}\"\n{}fracture_energy = {}\n{}", whole, elastic,
                     fracture_energy, law) +
         fmt::format("[[materials]]\nregions = [{}]\n{}fracture_energy = \"infinite\"\n",
                     unbreakable, elastic);
}

class Recorder final : public StepObserver {
 public:
  /// \param middle,spacing  of a strip; spacing 0: another body
  Recorder(double middle, double spacing) : middle_(middle), spacing_(spacing) {}
  void on_step(const StepRecord&, StateSource&) override { ++events; }
  void on_end(const StepRecord&, StateSource& source) override {
    if (spacing_ > 0.0) released = released_of(source.state(), middle_, spacing_);
  }
  int events = 0;
  Released released;

 private:
  double middle_, spacing_;
};

double length_of(const Make& make) { return (in_space(make) ? 60.0 : 100.0) + make.longer; }

}  // namespace

double section_of(const Make& make) { return in_space(make) ? bar_width * bar_width : strip_width; }

double soft_length_of(const Make& make) {
  return 2.0 * (make.horizon_ratio + 1.0) * make.spacing + make.longer;
}

std::string strip(const Make& make) {
  const bool space = in_space(make);
  const double length = length_of(make), width = space ? bar_width : strip_width;
  const double z = space ? width : 0.0, half = 0.5 * soft_length_of(make);
  return body(make, "strip.geo") + region("strip", 0, length, 0, width, z) +
         region("left part", 0, 0.5 * length - half, 0, width, z) +
         region("right part", 0.5 * length + half, length, 0, width, z) +
         region("left", 0, 0, 0, width, z) + region("right", length, length, 0, width, z) +
         region("lower", 0, 0, 0, 0, z) +
         (space ? region("front", 0, 0, 0, width, 0) + "z = [0, 0]\n" : "") +
         materials(make, "strip", "\"left part\", \"right part\"") +
         "[[supports]]\nregion = \"left\"\nfix = [\"x\"]\n"
         "[[supports]]\nregion = \"lower\"\nfix = [\"y\"]\n" +
         (space ? "[[supports]]\nregion = \"front\"\nfix = [\"z\"]\n" : "") +
         "[[displacements]]\nregion = \"right\"\nx = 0.1\n[stop]\nload_fraction = 1e-6\n";
}

std::string beam(const Make& make, const Beam& size) {
  const double depth = size.depth, span = 4.0 * depth, length = 4.4 * depth, middle = 0.5 * length;
  const double zone = std::max(0.4 * depth, 6.0 * make.horizon_ratio * make.spacing);
  const double half = 0.5 * std::max(2.0 * make.spacing, size.patch * depth);
  const double held = size.point_supports ? 0.0 : half;
  const double left = 0.5 * (length - span);
  const std::string crack = size.notch > 0.0
                                ? fmt::format("[[cracks]]\npoints = [[{0}, {1}], [{0}, {2}]]\n",
                                              middle, -make.spacing, size.notch * depth)
                                : "";
  return body(make, "beam.geo") + region("beam", 0, length, 0, depth, 0) +
         region("left part", 0, middle - zone, 0, depth, 0) +
         region("right part", middle + zone, length, 0, depth, 0) +
         region("left", left - held, left + held, 0, 0, 0) +
         region("right", length - left - held, length - left + held, 0, 0, 0) +
         region("load", middle - half, middle + half, depth, depth, 0) +
         materials(make, "beam", "\"left part\", \"right part\"") + crack +
         "[[supports]]\nregion = \"left\"\nfix = [\"x\", \"y\"]\n"
         "[[supports]]\nregion = \"right\"\nfix = [\"y\"]\n"
         "[[loads]]\nregion = \"load\"\nforce = [0, -1000]\n" +
         fmt::format("[stop]\nload_fraction = {}\n", size.load_fraction);
}

Outcome run_text(const std::string& text, const Make* make) {
  const CaseFile input = parse_case(text, PERILINK_STUDY_DIR "/specimen.toml");
  const Model model = build_model(input);
  Recorder recorder(make ? 0.5 * length_of(*make) : 0.0, make ? make->spacing : 0.0);
  const DamageResult result = run_damage_analysis(model, damage_options(input, 1), recorder);
  return {std::abs(result.smoothed_peak_load.value_or(result.peak_load)),
          result.last.dissipated_energy,
          result.energy_error,
          recorder.events,
          to_string(result.termination),
          recorder.released};
}

}  // namespace perilink::verification
