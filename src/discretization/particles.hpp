#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/types.hpp"

namespace perilink {

/// Kind of a particle.
enum class ParticleKind : std::uint8_t {
  solid,           ///< material of the body
  ghost,           ///< Peri2D's ghost: no modulus; bonds to solid particles at half stiffness
  rebar,           ///< node of a reinforcing bar
  embedded_point,  ///< point moved by the particles around it (EmbeddedPoints)
};

/// Returns whether supports and loads may act on it: a solid particle or a bar node.
inline bool is_material(ParticleKind kind) {
  return kind == ParticleKind::solid || kind == ParticleKind::rebar;
}

/// Particles of a body as a structure of arrays: solid particles, ghosts, bar nodes, embedded
/// points, in this order.
struct Particles {
  int dim = 2;
  std::vector<double> positions;  ///< [length], shape (size, dim), row after row
  std::vector<double> volumes;    ///< integral of the particle's shape function [length^3]
  std::vector<Index> material;    ///< index into the case's materials; no_index for ghosts and bars
  std::vector<ParticleKind> kind;

  Index size() const { return static_cast<Index>(volumes.size()); }
  std::span<const double> position(Index i) const {
    return {positions.data() + static_cast<std::size_t>(i) * dim, static_cast<std::size_t>(dim)};
  }
};

}  // namespace perilink
