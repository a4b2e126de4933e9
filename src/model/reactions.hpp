#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "io/fields/vtu.hpp"
#include "model/model.hpp"
#include "model/model_state.hpp"

/// \file
/// Reactions of supports, planes of symmetry, springs and prescribed displacements.

namespace perilink {

/// Returns nonzero for every particle component that is prescribed in any stage or has a spring;
/// shape (particles, width).
std::vector<std::uint8_t> held_slots(const Model& model);

/// Calls pass_to_held() for models with host elements; does nothing for others.
/// \param whole  see ModelState::whole
void pass_to_held(const Model& model, std::span<const std::uint8_t> whole,
                  std::span<const double> loads, std::span<double> forces);

/// Returns the reaction on each component, zero on free ones. In static equilibrium it is the
/// internal force minus the load.
/// \return shape (particles, width) [force], moments [force length]
std::vector<double> holding_forces(const Model& model, const ModelState& state);

/// Resultant force and moment on some particles.
struct Reaction {
  Vector3 middle{};  ///< mean position, reference point of the moment [length]
  Vector3 force{};
  Vector3 moment{};          ///< includes reactions to rotations
  double force_size = 0.0;   ///< sum of force magnitudes
  double moment_size = 0.0;  ///< sum of magnitudes of moments on rotations
};
Reaction reaction_on(const Model& model, std::span<const Index> particles,
                     std::span<const double> forces);

/// Returns a resultant with its moment about another point.
Reaction about(const Vector3& point, Reaction reaction);

/// Returns all loads at the current load factors, shape (particles, width) [force].
std::vector<double> present_loads(const Model& model, const ModelState& state);

/// Particles supported by an entry of the case.
struct SupportRegion {
  std::string name;  ///< "supports: left", "symmetry: x = 0"
  std::vector<Index> particles;
};

/// Returns the support regions, with every held particle in the first of its entries. Regions come
/// from [[supports]], [[symmetry]], [[springs]], [[displacements]] and [[velocities]]; entries of
/// one table and region form one region.
std::vector<SupportRegion> support_regions(const CaseFile& input, const Model& model);

struct ReactionTable {
  /// CSV text: a row for each region, one for all loads and one for the sum. Moments of the last
  /// two rows are about the origin.
  std::string text;
  /// Sum of loads and reactions, about the middle of all particles. Its magnitudes include the
  /// forces of bars, which a prestrain gives to bodies without loads and reactions.
  Reaction sum;
  /// Forces that the last digits of the displacements cause, for example where a body moves far
  /// more than it is strained [force].
  double round_off = 0.0;
};
/// \param forces  holding_forces() where they are known, as for bodies in motion
ReactionTable reaction_table(const std::vector<SupportRegion>& places, const Model& model,
                             const ModelState& state, std::vector<double> forces = {});

/// Returns point fields of supports and loads, which stay the same over a run; without those that
/// are zero everywhere:
///   held                    sum of 1, 2 and 4 for components along x, y and z that are prescribed
///                           or have a spring
///   applied_force           at load factor 1 [force]
///   prescribed_displacement at load factor 1 [length]
std::vector<VtuArray> condition_fields(const Model& model);

/// Checks the balance of reactions and loads over the rows of a quasistatic run.
class ReactionBalance {
 public:
  /// \param sum        see ReactionTable
  /// \param length     longest side of the body [length]
  /// \param tolerance  on the sum over the largest magnitude of loads and reactions so far [-]
  /// \param round_off  sum of forces that is round-off [force]
  void add(Index row, const Reaction& sum, double length, double tolerance, double round_off = 0.0);
  /// Returns a warning about the first row with reactions out of balance.
  std::optional<std::string> warning() const;

  template <class Archive>
  void serialize(Archive& archive) {
    archive(size_, row_, imbalance_);
  }

 private:
  double size_ = 0.0;       // largest sum of magnitudes of loads and reactions so far [force]
  Index row_ = 0;           // first row out of balance; 0: none
  double imbalance_ = 0.0;  // imbalance of this row over size_ [-]
};

}  // namespace perilink
