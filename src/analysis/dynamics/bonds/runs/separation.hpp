#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "network/builder/free_bodies.hpp"

namespace perilink {

/// Finds whether broken bonds have left a body in pieces that cannot be in equilibrium with its
/// loads, or that no prescribed displacement strains.
class Separation {
 public:
  /// \param problem  must outlive this object
  explicit Separation(const LoadedNetwork& problem);

  /// Returns whether bonds have broken since the last examination, or there was none.
  /// \param fractured  energy of broken bonds so far [force length]
  bool is_due(double fractured) const { return fractured > examined_; }
  /// Returns whether contact springs join and release pieces as the body moves.
  bool follows_contact() const { return problem_.network.num_contacts > 0; }
  /// Examines the pieces. Closed contact springs join them.
  /// \param is_loaded  the load factor is not zero
  /// \return description of the piece that the loads pull away; empty: none
  std::string examine(Secants secants, double fractured, bool is_loaded);
  /// Returns whether prescribed displacements strained the body and now strain no piece of it.
  bool is_unstrained() const { return is_unstrained_; }
  /// Returns whether a motion d of the free components shows that no equilibrium is near. In
  /// equilibrium the stored energy is at least (f'd)^2 / (2 d'K d) (Cauchy-Schwarz). If it exceeds
  /// the work of the loads over many sizes of the body, d is nearly free of strain.
  /// \param work       f'd at the load factor [force length]
  /// \param stiffness  d'K d without breaking bonds [force length]
  bool is_mechanism(double work, double load_factor, double stiffness) const;
  /// Returns `fractured` of the last examination [force length]; negative: there was none.
  double examined() const { return examined_; }
  /// Continues after the last examination of a saved run.
  void restore(double examined, bool is_unstrained) {
    examined_ = examined;
    is_unstrained_ = is_unstrained;
  }

 private:
  /// Returns the sum of the magnitudes of the forces on a piece [force].
  double size_of_loads(const Fragment& piece) const;
  bool is_strained(Secants secants, const std::vector<std::uint8_t>& held) const;

  const LoadedNetwork& problem_;
  std::vector<std::uint8_t> held_, resisted_;  ///< resisted: also by elastic supports
  double largest_ = 0.0;                       ///< prescribed displacement [length]
  bool closes_ = false;                        ///< Network::has_closing()
  double far_ = 0.0;        ///< work of the loads that no elastic body takes up [force length]
  double examined_ = -1.0;  ///< `fractured` of the last examination [force length]
  bool is_unstrained_ = false;
};

}  // namespace perilink
