#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "discretization/lattices/lattice.hpp"

/// \file
/// The three specimens of the study, each as a case file and with what is known of it beforehand.

namespace perilink::verification {

enum class Shape {
  block,         ///< pulled apart between two caps that do not break, weaker in the middle
  notched_beam,  ///< three-point bending; the crack has to begin at a notch with two square corners
  cracked_beam,  ///< three-point bending of a beam with a sharp crack, which has a closed form
};

/// A body in which one crack grows.
struct Specimen {
  Shape shape = Shape::block;
  double spacing = 1.0;  ///< [length]
  int horizon_ratio = 3;
  Surface surface = Surface::calibrated;
  std::string name;                   ///< "notched beam"
  std::string text;                   ///< the case file
  int along = 1;                      ///< axis along which the crack grows, 0 or 1
  std::array<double, 2> ligament{};   ///< what there is to crack on that axis [length]
  std::array<double, 2> inside{};     ///< a point far from surfaces and the weak patch [length]
  double thickness = 1.0;             ///< [length]
  double fracture_energy = 0.0;       ///< [force/length]
  std::optional<Box> weak;            ///< where it is less ...
  double weak_fracture_energy = 0.0;  ///< ... namely this [force/length]
  std::vector<std::array<double, 2>> corners;  ///< corners of the notch at its end [length]
  std::optional<double> griffith_load;         ///< the crack would begin to grow at it [force]
};

/// \param spacing  [in] of the block, [mm] of the beams; has to divide their measures
Specimen make_specimen(Shape shape, double spacing, Surface surface, int horizon_ratio = 3);

/// "calibrated", the word of the case file.
std::string surface_word(Surface surface);

}  // namespace perilink::verification
