#include "plates.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "io/case/case_file.hpp"
#include "law.hpp"
#include "model/from_case/configure.hpp"

namespace perilink::verification {
namespace {

constexpr double thickness = side / 3.0;

std::string body_lines(const std::string& body) {
  if (body == "mesh") return "mesh = \"square.geo\"\nmesh_size = 8.4667\nhorizon_ratio = 3\n";
  if (body == "lattice") return fmt::format("spacing = {:.12g}\nhorizon_ratio = 3\n", side / 24.0);
  return fmt::format("problem = \"three_dimensional\"\nspacing = {:.12g}\nhorizon_ratio = 2\n",
                     side / 9.0);
}

std::string face(const char* name, int axis, double at, bool in_space, double traction) {
  std::string lines = fmt::format("[[regions]]\nname = \"{}\"\n", name);
  const double reach[3] = {side, side, thickness};
  for (int a = 0; a < (in_space ? 3 : 2); ++a) {
    lines +=
        fmt::format("{} = [{}, {}]\n", "xyz"[a], a == axis ? at : 0.0, a == axis ? at : reach[a]);
  }
  if (traction == 0.0) return lines;
  const double outward = at > 0.0 ? traction : -traction;
  lines += fmt::format("[[tractions]]\nregion = \"{}\"\ntraction = [{}, {}{}]\n", name,
                       axis == 0 ? outward : 0.0, axis == 1 ? outward : 0.0, in_space ? ", 0" : "");
  return lines;
}

/// Unbreakable corners: their particles have the fewest bonds, and are torn out by the tractions
/// before anything else where bonds may break.
std::string corners(bool in_space) {
  constexpr double width = 0.1 * side;
  std::string lines, names;
  for (int k = 0; k < 4; ++k) {
    const double x = k % 2 ? side : width, y = k / 2 ? side : width;
    lines += fmt::format("[[regions]]\nname = \"corner {}\"\nx = [{}, {}]\ny = [{}, {}]\n{}", k,
                         x - width, x, y - width, y,
                         in_space ? fmt::format("z = [0, {}]\n", thickness) : "");
    names += fmt::format("{}\"corner {}\"", k ? ", " : "", k);
  }
  return lines + fmt::format(
                     "[[materials]]\nregions = [{}]\nyoungs_modulus = 24850\n"
                     "poissons_ratio = 0.22\nfracture_energy = \"infinite\"\n",
                     names);
}

class CurveRecorder final : public StepObserver {
 public:
  void on_step(const StepRecord& row, StateSource& /*source*/) override {
    ++events;
    if (row.load_factor > strength) {
      strength = row.load_factor;
      strain = row.displacement;
    }
    if (events % 20 == 1) curve.emplace_back(row.displacement, row.load_factor);
  }
  int events = 0;
  double strength = 0.0, strain = 0.0;
  std::vector<std::pair<double, double>> curve{{0.0, 0.0}};
};

}  // namespace

std::string plate_case(const Plate& plate) {
  const bool in_space = plate.body == "slab";
  return fmt::format(
             "title = \"Plate of concrete, {} : {}\"\nunits = \"N, mm\"\n"
             "[body]\nmodel = \"micropolar\"\n{}[[regions]]\nname = \"plate\"\n"
             "x = [0, {}]\ny = [0, {}]\n{}[[materials]]\nregion = \"plate\"\n{}",
             plate.along_x, plate.along_y, body_lines(plate.body), side, side,
             in_space ? fmt::format("z = [0, {}]\n", thickness) : "",
             law_lines(plate.shear_softens)) +
         corners(in_space) + face("left", 0, 0.0, in_space, plate.along_x) +
         face("right", 0, side, in_space, plate.along_x) +
         face("lower", 1, 0.0, in_space, plate.along_y) +
         face("upper", 1, side, in_space, plate.along_y) +
         "[analysis]\nrigid_body_modes = \"pin\"\n[stop]\nload_fraction = 0.3\n";
}

PlateResult load_plate(const Plate& plate) {
  const CaseFile input = parse_case(plate_case(plate), PERILINK_STUDY_DIR "/plate.toml");
  const Model model = build_model(input);
  CurveRecorder recorder;
  const DamageResult run = run_damage_analysis(model, damage_options(input, 1), recorder);
  // The displacement is conjugate to the reference load, which is that of load factor 1.
  const double volume = side * side * (plate.body == "slab" ? thickness : 1.0);
  const double strain_of_length = model.reference.value / volume;
  for (auto& point : recorder.curve) point.first *= strain_of_length;
  const MaterialStrength& cell = model.network.report.strengths.front();
  return {recorder.strength,     recorder.strain * strain_of_length,
          cell.tensile_strength, cell.compressive_strength,
          run.energy_error,      recorder.events,
          run.broken_bonds,      to_string(run.termination),
          recorder.curve};
}

}  // namespace perilink::verification
