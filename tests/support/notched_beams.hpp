#pragma once

#include <fmt/format.h>

#include <string>

/// \file
/// Softening bodies with a notch.

namespace perilink::test {

/// Softening beam on two supports with a notch beside its middle, displaced downwards at its top or
/// loaded by a force.
struct NotchedBeam {
  std::string model = "bond_based";
  double spacing = 2.5;    ///< [length]
  double force = 0.0;      ///< on the top, instead of a displacement
  double weight = 0.0;     ///< force on the top in an earlier stage
  double tolerance = 0.0;  ///< event_tolerance
  std::string analysis;    ///< lines of [analysis]
  std::string stop = "load_fraction = 0.3";
  std::string sections;  ///< further tables at the end
};

inline std::string notched_beam_case(const NotchedBeam& beam) {
  const std::string ratio = beam.model == "micropolar" ? "poissons_ratio = 0.2\n" : "";
  std::string text = fmt::format(
      "[body]\nproblem = \"plane_stress\"\nmodel = \"{}\"\npattern = \"rectangular\"\n"
      "spacing = {}\nhorizon_ratio = 3\n",
      beam.model, beam.spacing);
  const auto region = [&](const char* name, double from, double to, double low, double high) {
    text += fmt::format("[[regions]]\nname = \"{}\"\nx = [{}, {}]\ny = [{}, {}]\n", name, from, to,
                        low, high);
  };
  region("beam", 0, 120, 0, 30);
  region("middle", 40, 80, 0, 30);
  region("left", 0, 0, 0, 0);
  region("right", 120, 120, 0, 0);
  region("top", 55, 65, 30, 30);
  text +=
      "[[materials]]\nname = \"ends\"\nregion = \"beam\"\nyoungs_modulus = 30000\n"
      "fracture_energy = \"infinite\"\n" +
      ratio +
      "[[materials]]\nname = \"middle\"\nregion = \"middle\"\nyoungs_modulus = 30000\n"
      "fracture_energy = 0.1\ntensile_strength = 3.0\nsoftening = \"linear\"\n" +
      ratio +
      "[[cracks]]\npoints = [[61, -1], [61, 10]]\n"
      "[[supports]]\nregion = \"left\"\nfix = [\"x\", \"y\"]\n"
      "[[supports]]\nregion = \"right\"\nfix = [\"y\"]\n";
  if (beam.weight > 0.0) {
    text += fmt::format("[[loads]]\nregion = \"top\"\nforce = [0, {}]\nstage = \"weight\"\n",
                        -beam.weight);
  }
  text += beam.force > 0.0
              ? fmt::format("[[loads]]\nregion = \"top\"\nforce = [0, {}]\n", -beam.force)
              : "[[displacements]]\nregion = \"top\"\ny = -0.05\n";
  if (beam.weight > 0.0) text += "stage = \"push\"\n";
  text += "[analysis]\n" + beam.analysis;
  text += fmt::format("event_tolerance = {}\n", beam.tolerance);
  text += beam.weight > 0.0 ? "[[stages]]\nname = \"weight\"\nto = 1.0\n"
                              "[[stages]]\nname = \"push\"\nto = 2.5\n"
                            : "[stop]\n" + beam.stop + "\n";
  return text + beam.sections;
}

/// Returns a bar in space with a notch in its middle, which softens in tension.
inline std::string notched_bar_case(const std::string& solver, double tolerance) {
  std::string text =
      "[body]\nproblem = \"three_dimensional\"\npattern = \"cubic\"\nspacing = 5\n"
      "horizon_ratio = 2\n";
  for (const auto& [name, from, to] : {std::tuple("bar", 0, 60), std::tuple("middle", 20, 40),
                                       std::tuple("left", 0, 5), std::tuple("right", 55, 60)}) {
    text += fmt::format("[[regions]]\nname = \"{}\"\nx = [{}, {}]\ny = [0, 20]\nz = [0, 20]\n",
                        name, from, to);
  }
  return text +
         "[[materials]]\nregion = \"bar\"\nyoungs_modulus = 30000\n"
         "fracture_energy = \"infinite\"\n"
         "[[materials]]\nregion = \"middle\"\nyoungs_modulus = 30000\nfracture_energy = 0.05\n"
         "tensile_strength = 3.0\nsoftening = \"linear\"\n"
         "[[cracks]]\nclosing = false\n"
         "corners = [[31.2, -1, -1], [31.2, -1, 25], [31.2, 7, 25], [31.2, 7, -1]]\n"
         "[[supports]]\nregion = \"left\"\nfix = [\"x\", \"y\", \"z\"]\n"
         "[[displacements]]\nregion = \"right\"\nx = 0.02\ny = 0\nz = 0\n" +
         fmt::format("[analysis]\nsolver = \"{}\"\nevent_tolerance = {}\n", solver, tolerance) +
         "[stop]\nload_fraction = 0.3\n";
}

}  // namespace perilink::test
