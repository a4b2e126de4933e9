#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "network/builder/free_bodies.hpp"

namespace perilink {

/// Finds whether broken bonds have left a body in pieces that can be in no equilibrium with its
/// loads, or that nothing prescribed strains any more.
class Separation {
 public:
  /// \param problem  has to outlive this
  explicit Separation(const LoadedNetwork& problem);

  /// Whether bonds have broken since the pieces were examined, or they never were.
  /// \param fractured  energy of broken bonds so far [force length]
  bool is_due(double fractured) const { return fractured > examined_; }
  /// \param is_loaded  the load factor is not zero
  /// \return which piece the loads pull away; empty: none
  std::string examine(Secants secants, double fractured, bool is_loaded);
  /// Whether the prescribed displacements strained the body and strain no piece of it any more.
  bool is_unstrained() const { return is_unstrained_; }

 private:
  /// Sum of the sizes of the forces on a piece [force].
  double size_of_loads(const Fragment& piece) const;
  bool is_strained(Secants secants, const std::vector<std::uint8_t>& held) const;

  const LoadedNetwork& problem_;
  std::vector<std::uint8_t> held_, resisted_;  ///< resisted: also by elastic supports
  double largest_ = 0.0;                       ///< prescribed displacement [length]
  double examined_ = -1.0;                     ///< `fractured` of the last time [force length]
  bool is_unstrained_ = false;
};

}  // namespace perilink
