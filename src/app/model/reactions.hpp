#pragma once

#include <cstdint>
#include <optional>
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

/// pass_to_held() of a model, whose bodies without elements it leaves as they are.
/// \param whole  see ModelState::whole
void pass_to_held(const Model& model, std::span<const std::uint8_t> whole,
                  std::span<const double> loads, std::span<double> forces);

/// Force of what holds each component; zero where nothing does. Of a body at rest: what its
/// elements leave less the loads.
/// \return shape (particles, width) [force], moments [force length]
std::vector<double> holding_forces(const Model& model, const ModelState& state);

/// Resultant on some particles.
struct Reaction {
  Vector3 middle{};  ///< mean of their positions, about which the moment counts [length]
  Vector3 force{};
  Vector3 moment{};          ///< with the moments that hold rotations
  double force_size = 0.0;   ///< sum of the sizes of the forces
  double moment_size = 0.0;  ///< sum of the sizes of moments on rotations
};
Reaction reaction_on(const Model& model, std::span<const Index> particles,
                     std::span<const double> forces);

/// Particles that an entry of the case holds.
struct SupportRegion {
  std::string name;  ///< "supports: left", "symmetry: x = 0"
  std::vector<Index> particles;
};

/// Every particle that is held, once: those that several entries hold are at the first. The regions
/// of [[supports]], planes of [[symmetry]], regions of [[springs]], [[displacements]] and
/// [[velocities]]; entries of one table and region are one place.
std::vector<SupportRegion> support_regions(const CaseFile& input, const Model& model);

struct ReactionTable {
  /// A row for each place, one for all loads and one for the sum of all, with moments about the
  /// origin in the last two; as text of a CSV.
  std::string text;
  Reaction sum;  ///< sum of loads and reactions, about the middle of all particles
};
/// \param forces  holding_forces(), where they are known already: of bodies in motion
ReactionTable reaction_table(const std::vector<SupportRegion>& places, const Model& model,
                             const ModelState& state, std::vector<double> forces = {});

/// Compares reactions with loads over the rows of a quasistatic run.
class ReactionBalance {
 public:
  /// \param sum        see ReactionTable
  /// \param length     longest side of the body [length]
  /// \param tolerance  on the sum over the largest size of loads and reactions so far [-]
  void add(Index row, const Reaction& sum, double length, double tolerance);
  /// A warning about the first row whose reactions do not balance its loads.
  std::optional<std::string> warning() const;

 private:
  double size_ = 0.0;       // largest sum of the sizes of loads and reactions so far [force]
  Index row_ = 0;           // first row out of balance; 0: none
  double imbalance_ = 0.0;  // imbalance of this row over size_ [-]
};

}  // namespace perilink
