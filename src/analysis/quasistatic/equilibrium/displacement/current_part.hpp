#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "analysis/quasistatic/equilibrium/body/damaged_body.hpp"
#include "assembly/internal_force.hpp"

namespace perilink {

/// The part of the displacements that events keep current. Under forces only, an event needs the
/// ends of elements that can fail. The backward pass of a factor then skips other parts of the
/// body. Elements and unknowns in this part have a residual check of their own.
class CurrentPart {
 public:
  /// Selects all displacements.
  void select_all() { is_all_ = true; }
  /// Selects the ends of elements that can fail.
  /// \return flag per unknown: is selected
  std::vector<std::uint8_t> select_ends(const DamagedBody& body);
  /// Returns whether all displacements are selected.
  bool is_all() const { return is_all_; }

  /// Writes the selected displacements, and perhaps others, of a solution.
  void move(const DamagedBody& body, std::span<const double> values,
            std::vector<double>& displacement) const;

  /// Returns whether some unknowns can be checked.
  bool can_be_checked() const { return !checked_elements_.empty(); }
  /// Returns the norm of the residual forces on these unknowns.
  double residual(const DamagedBody& body, const Loads& loads, std::span<const double> displacement,
                  InternalForce& internal) const;

 private:
  void select_checked(const DamagedBody& body, const std::vector<std::uint8_t>& current);

  bool is_all_ = true;
  std::vector<std::size_t> slots_;  ///< with embedded particles: selected slots that unknowns move
  /// All elements of the unknowns in the residual check.
  std::vector<Index> checked_elements_;
  std::vector<std::uint8_t> checked_;  ///< flag per unknown
};

}  // namespace perilink
