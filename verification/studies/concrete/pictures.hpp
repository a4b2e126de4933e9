#pragma once

#include <string>
#include <vector>

#include "app/plot/svg.hpp"
#include "homogeneous.hpp"
#include "plates.hpp"

namespace perilink::verification {

struct UniformRun {
  ReferenceCurve reference;
  std::vector<HomogeneousPoint> points;
};
/// Stress over strain, free across, lines the reference.
Svg draw_uniform(const std::vector<UniformRun>& runs);

struct PlateRun {
  std::string body;
  double x = 0.0, y = 0.0;  ///< ratio of the tractions
  PlateResult result;
};
/// Strengths over that in uniaxial compression.
Svg draw_envelope(const std::vector<PlateRun>& runs);
/// Stress over strain of plates on the lattice and the mesh under load along one axis.
Svg draw_curves(const std::vector<PlateRun>& runs);

}  // namespace perilink::verification
