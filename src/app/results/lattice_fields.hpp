#pragma once

#include "analysis/dynamics/lattice/lattice_analysis.hpp"
#include "io/fields/vtu.hpp"

namespace perilink {

/// The state of a lattice as a grid to look at: a vertex for each particle at its reference
/// position (z = 0 in two dimensions). Fields:
///   points  displacement, velocity, damage, region, kind, volume; of unbreakable bodies stress
///           (xx, yy, zz, xy, yz, xz)
///   cells   element (FieldElement::particle), broken_at (which particle of the run it was
///           whose damage began, from 1; 0: none)
///   file    step, time, load_factor, load, dimension, spacing; in the plane thickness
VtuGrid make_lattice_grid(const ExplicitModel& model, const ExplicitState& state,
                          const ExplicitRecord& record);

}  // namespace perilink
