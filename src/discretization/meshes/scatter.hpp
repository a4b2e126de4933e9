#pragma once

#include <cstdint>
#include <span>

#include "discretization/meshes/mesh.hpp"

namespace perilink {

/// Moves the inner points of a mesh at random, so that they lie in no rows. Points on the surface
/// and on faces between parts stay. Cells keep at least 0.4 of their volume: points of other cells
/// return. Equal seeds give equal moves.
/// \param part    part of every cell
/// \param amount  largest move along each axis [length]
void scatter_points(Mesh& mesh, std::span<const Index> part, double amount, std::uint32_t seed);

}  // namespace perilink
