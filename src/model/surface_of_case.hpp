#pragma once

#include "assembly/results/surface_conditions.hpp"
#include "model/model.hpp"

namespace perilink {

/// Returns where a model is known to be unloaded, from its facets, loads and unknowns. Nothing is
/// known in explicit runs, where inertia acts, and if bonds near the surface are not calibrated.
SurfaceConditions surface_of_case(const CaseFile& input, const Model& model);

}  // namespace perilink
