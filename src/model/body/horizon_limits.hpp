#pragma once

#include <optional>
#include <string>

#include "discretization/lattices/lattice.hpp"
#include "io/case/case_file.hpp"
#include "model/model.hpp"

namespace perilink {

/// Returns the key of [body] that gives the horizon.
std::string horizon_key(const BodySection& body);

/// Sizes against which a horizon is checked before bonds are made.
struct HorizonReach {
  double horizon = 0.0;    ///< [length]
  double spacing = 0.0;    ///< spacing of particles, mean edge of a mesh [length]
  double particles = 0.0;  ///< approximate number
  Vector3 extents{};       ///< size of the body along each axis [length]
  int dim = 2;
  double memory = 0.0;  ///< memory of the machine [bytes]
};

/// Returns the sizes for the particles of a body on this machine.
HorizonReach reach_of(const Particles& particles, double horizon, double spacing);
/// Returns the sizes for a lattice that fills a box on this machine.
HorizonReach reach_of(const Box& box, int dim, double horizon, double spacing);

/// Refuses a horizon below the spacing, and one that bonds all particles to each other in a larger
/// body. Also refuses a horizon with more bonds than memory or the index type can hold.
/// \throws InputError
void refuse_impossible_horizon(const CaseFile& input, const HorizonReach& reach);

/// Refuses square and cubic lattices with bonds along the rows only, which resist no shear.
/// \throws InputError
void refuse_shearing_lattice(const CaseFile& input, const Lattice& lattice, double horizon);

/// Returns a note on a body, or a quarter of its particles, so thin that bonds make it too stiff in
/// bending by more than 10 %. Bodies on elements or symmetry planes, shells and beams have none.
std::optional<std::string> thin_body_note(const CaseFile& input, const Model& model);

}  // namespace perilink
