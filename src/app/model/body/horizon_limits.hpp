#pragma once

#include "discretization/lattices/lattice.hpp"
#include "io/case/case_file.hpp"

namespace perilink {

/// Key of [body] that gives the horizon.
std::string horizon_key(const BodySection& body);

/// What a horizon is held against before a bond is made.
struct HorizonReach {
  double horizon = 0.0;    ///< [length]
  double spacing = 0.0;    ///< spacing of particles, mean edge of a mesh [length]
  double particles = 0.0;  ///< about
  Vector3 extents{};       ///< size of the body along each axis [length]
  int dim = 2;
  double memory = 0.0;  ///< what the machine has [bytes]
};

/// The same of the particles of a body on this machine.
HorizonReach reach_of(const Particles& particles, double horizon, double spacing);
/// The same of a lattice that fills a box.
HorizonReach reach_of(const Box& box, int dim, double horizon, double spacing);

/// Refuses a horizon below the spacing, one far longer than the body, which bonds every particle to
/// every other, and one whose bonds no memory or number can hold.
/// \throws InputError
void refuse_impossible_horizon(const CaseFile& input, const HorizonReach& reach);

/// Refuses bonds along the rows of a square or cubic lattice only, which resist no shear.
/// \throws InputError
void refuse_shearing_lattice(const CaseFile& input, const Lattice& lattice, double horizon);

}  // namespace perilink
