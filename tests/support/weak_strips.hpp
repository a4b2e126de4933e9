#pragma once

#include <fmt/format.h>

#include <string>

/// \file
/// Bodies that are unbreakable except at an interface between two regions.

namespace perilink::test {

/// Strip, or bar of square section, in tension across an interface in its middle.
struct WeakStrip {
  bool in_space = false;
  std::string model = "bond_based";
  std::string pattern = "rectangular";
  std::string softening = "linear";
  double length = 100.0, width = 50.0;  ///< [length]
  double spacing = 5.0;                 ///< a third of the horizon [length]
  double stiffer = 1.0;                 ///< modulus of the second half over the modulus of the
                                        ///< first
  double tensile_strength = 3.0;        ///< [force/length^2]
  double fracture_energy = 0.1;         ///< [force/length]

  double area() const { return in_space ? width * width : width; }
};

inline std::string weak_region(const WeakStrip& strip, const std::string& name, double from,
                               double to, double y, double z) {
  std::string text =
      fmt::format("[[regions]]\nname = \"{}\"\nx = [{}, {}]\ny = [0, {}]\n", name, from, to, y);
  if (strip.in_space) text += fmt::format("z = [0, {}]\n", z);
  return text;
}

inline std::string weak_support(const std::string& region, const std::string& axis) {
  return fmt::format("[[supports]]\nregion = \"{}\"\nfix = [\"{}\"]\n", region, axis);
}

inline std::string weak_strip_case(const WeakStrip& strip) {
  const double l = strip.length, w = strip.width, half = 0.5 * strip.length;
  const std::string ratio = strip.model == "micropolar" ? "poissons_ratio = 0.2\n" : "";
  std::string text = fmt::format(
      "[body]\nproblem = \"{}\"\nmodel = \"{}\"\npattern = \"{}\"\nspacing = {}\n"
      "horizon_ratio = 3\n",
      strip.in_space ? "three_dimensional" : "plane_stress", strip.model, strip.pattern,
      strip.spacing);
  text += weak_region(strip, "first", 0, half, w, w) + weak_region(strip, "second", half, l, w, w) +
          weak_region(strip, "left", 0, 0, w, w) + weak_region(strip, "edge", 0, 0, 0, w) +
          weak_region(strip, "corner", 0, 0, 0, 0) + weak_region(strip, "right", l, l, w, w) +
          weak_region(strip, "far edge", l, l, 0, w);
  if (strip.in_space) text += weak_region(strip, "far side", l, l, w, 0);
  for (const auto& [name, factor] : {std::pair("first", 1.0), std::pair("second", strip.stiffer)}) {
    text += fmt::format(
        "[[materials]]\nname = \"{0}\"\nregion = \"{0}\"\nyoungs_modulus = {1}\n"
        "fracture_energy = \"infinite\"\n{2}",
        name, 30000.0 * factor, ratio);
  }
  text += fmt::format(
      "[[interfaces]]\nbetween = [\"first\", \"second\"]\nfracture_energy = {}\n"
      "tensile_strength = {}\nsoftening = \"{}\"\n",
      strip.fracture_energy, strip.tensile_strength, strip.softening);
  // These supports prevent sliding, so that the last bonds across the interface break too.
  text += weak_support("left", "x") + weak_support("edge", "y") + weak_support("far edge", "y");
  if (strip.in_space) text += weak_support("corner", "z") + weak_support("far side", "z");
  return text + "[[displacements]]\nregion = \"right\"\nx = 0.2\n[stop]\nload_fraction = 1e-5\n";
}

}  // namespace perilink::test
