#pragma once

#include <string>
#include <utility>
#include <vector>

#include "app/plot/svg.hpp"

namespace perilink::verification {

/// A row of homogeneous.csv with free sides.
struct UniformRow {
  bool shear_softens = false;
  double strain = 0.0;  ///< its size
  double stress = 0.0, reference = 0.0;
};
/// Stress over strain, lines the reference.
Svg draw_uniform(const std::vector<UniformRow>& rows);

/// A row of plates.csv.
struct PlateRow {
  std::string body;
  double x = 0.0, y = 0.0;  ///< ratio of the tractions
  double strength = 0.0;
};
/// Strengths over that in uniaxial compression.
Svg draw_envelope(const std::vector<PlateRow>& rows);

/// Strains and stresses of a plate under load along one axis.
struct PlateCurve {
  std::string body;
  std::vector<std::pair<double, double>> tension, compression;
};
Svg draw_curves(const std::vector<PlateCurve>& plates);

}  // namespace perilink::verification
