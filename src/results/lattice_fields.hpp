#pragma once

#include "analysis/dynamics/lattice/lattice_analysis.hpp"
#include "io/fields/vtu.hpp"

namespace perilink {

/// Returns the state of a lattice as a grid: a vertex for each particle at its reference position
/// (z = 0 in two dimensions). Fields:
///   points  displacement, velocity, damage, region, kind, volume; for unbreakable bodies stress
///           (xx, yy, zz, xy, yz, xz)
///   cells   element (FieldElement::particle), broken_at (rank of the particle in the order of
///           cracking, from 1; 0: none)
///   file    step, time, load_factor, load, dimension, spacing; in two dimensions thickness
VtuGrid make_lattice_grid(const ExplicitModel& model, const ExplicitState& state,
                          const ExplicitRecord& record);

}  // namespace perilink
