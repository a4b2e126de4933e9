#pragma once

#include <vector>

#include "analysis/dynamics/lattice/body/lattice_particles.hpp"

namespace perilink {

/// Plastic strain of a particle by the printed rules: that of the plastic stretches that it has
/// (2018, Eq. 25).
double printed_plastic_strain(const ExplicitModel& model, const LatticeParticles& particles,
                              const ExplicitState& state, Index row, Index slot);

/// Lets the particles of a row in the plane flow by the rules of 2018: one step along the deviator
/// of the bond forces (Eqs. 26–30) where the von Mises stress is above the yield stress, which
/// hardens with the plastic strain and falls by a factor in every step beyond the ultimate one
/// (Eq. 24). In loops that the compiler vectorises.
/// \param due  slots to look at
/// \returns whether any flowed
bool flow_row_as_printed(const ExplicitModel& model, const LatticeParticles& particles,
                         ExplicitState& state, Index row, const std::vector<Index>& due);

}  // namespace perilink
