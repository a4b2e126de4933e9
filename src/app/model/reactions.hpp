#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "app/model/model.hpp"
#include "app/model/model_state.hpp"

/// \file
/// Forces of what holds a body on it: supports, planes of symmetry, springs, driven displacements.

namespace perilink {

/// Nonzero for every component of a particle that is prescribed, in any stage, or on a spring;
/// shape (particles, width).
std::vector<std::uint8_t> held_slots(const Model& model);

/// Force of what holds each component; zero where nothing does. Of a body at rest: what its
/// elements leave less the loads.
/// \return shape (particles, width) [force], moments [force length]
std::vector<double> holding_forces(const Model& model, const ModelState& state);

/// Resultant on some particles.
struct Reaction {
  Vector3 middle{};  ///< mean of their positions, about which the moment counts [length]
  Vector3 force{};
  Vector3 moment{};  ///< with the moments that hold rotations
};
Reaction reaction_on(const Model& model, std::span<const Index> particles,
                     std::span<const double> forces);

/// Particles that an entry of the case holds.
struct HeldPlace {
  std::string name;  ///< "supports: left", "symmetry: x = 0"
  std::vector<Index> particles;
};

/// Every particle that is held, once: those that several entries hold are at the first. The regions
/// of [[supports]], planes of [[symmetry]], regions of [[springs]], [[displacements]] and
/// [[velocities]]; entries of one table and region are one place.
std::vector<HeldPlace> held_places(const CaseFile& input, const Model& model);

/// A row for each place, one for all loads and one for the sum of all, with moments about the
/// origin in the last two; as text of a CSV.
/// \param forces  holding_forces(), where they are known already: of bodies in motion
std::string reaction_table(const std::vector<HeldPlace>& places, const Model& model,
                           const ModelState& state, std::vector<double> forces = {});

}  // namespace perilink
