#pragma once

#include <span>
#include <vector>

#include "analysis/quasistatic/equilibrium/body/crack_faces.hpp"
#include "analysis/quasistatic/equilibrium/body/element_state.hpp"
#include "analysis/quasistatic/equilibrium/body/removal.hpp"
#include "network/loaded_network.hpp"
#include "network/secants.hpp"
#include "solver/supernodes/sparse_matrix.hpp"

namespace perilink {

/// A damaged element that carries on one side only: closed in compression, open in tension. Its
/// extension is n'(u_second - u_first).
struct UnilateralElement {
  Index element;
  std::size_t first, second;  ///< offsets of the ends in displacements of shape (particles, width)
  double n[3];
};

/// A damaged body as its stiffness K: the unknowns, the secants and contact states of the elements,
/// and ground springs on loose parts.
class DamagedBody {
 public:
  /// \param unknowns  motion of the particles; must outlive this object
  /// \param saved     state of this network with these unknowns; null: the intact body
  DamagedBody(const LoadedNetwork& problem, const Unknowns& unknowns, const ElementState* saved);
  DamagedBody(const DamagedBody&) = delete;

  /// Returns secants, contact states and ground springs without their loads.
  ElementState state() const;

  const Network& network() const { return network_; }
  const Unknowns& unknowns() const { return *unknowns_; }
  /// Changes the unknowns, which must outlive this object.
  void set_unknowns(const Unknowns& unknowns);
  std::size_t num_unknowns() const { return slot_of_.size(); }
  /// Returns one slot per unknown, see Unknowns::slots().
  const std::vector<std::size_t>& slots() const { return slot_of_; }

  /// Writes T q into the displacements of all particles. Slots without unknowns stay as they are.
  void move(std::span<const double> q, std::vector<double>& displacement) const;
  /// Computes K q.
  void multiply(std::span<const double> q, std::span<double> result) const;
  /// Returns K, the stiffness of elements and ground springs.
  SparseMatrix stiffness() const;

  /// Returns the present stiffness of every element over its intact stiffness.
  Secants secants() const { return axial_.empty() ? Secants(secants_) : Secants(secants_, axial_); }
  /// Returns the secant of an element's law.
  double secant_of(Index element) const {
    return keeps_shear(element) ? axial_[element] : secants_[element];
  }
  /// Sets the secant of an element's law; a closed bond opens.
  void set_secant(Index element, double secant) {
    secants_[element] = secant > 0.0 && keeps_shear(element) ? 1.0 : secant;
    if (!axial_.empty()) axial_[element] = secant;
  }
  /// Sets a smaller secant. An intact element whose law closes becomes unilateral.
  void weaken(Index element, double secant);
  /// Sets a former secant.
  /// \param intact  the element was intact and is no longer unilateral
  void take_back(Index element, double secant, bool intact);

  /// Returns the vectors that take an element to this secant.
  /// \param unknowns  these unknowns, perhaps with other prescribed motions
  Removal removal(const Unknowns& unknowns, Index element, double secant) const;

  /// Returns whether elements can be unilateral.
  bool has_sides() const { return !axial_.empty(); }
  /// Returns the unilateral elements in the order of damage, contiguous in memory since every event
  /// reads all of them.
  std::span<const UnilateralElement> unilateral() const { return unilateral_; }
  /// Returns an element's ends and direction.
  UnilateralElement ends_of(Index element) const;
  bool is_closed(Index element) const { return axial_[element] > secants_[element]; }
  /// Changes the contact state of a unilateral element.
  void turn(Index element) {
    axial_[element] = is_closed(element) ? secants_[element] : faces_.closed_ratio(element);
  }
  /// Returns the stiffness that a unilateral element has on its closed side only [-]. The element's
  /// intact stiffness is 1. It is zero for bonds oblique to a crack, which never close.
  double one_sided(Index element) const { return faces_.closed_ratio(element) - secants_[element]; }
  /// Returns the vector of that stiffness.
  Removal one_sided_removal(Index element) const;
  CrackFaces& faces() { return faces_; }

  /// Returns the stiffness of ground springs per unknown; empty: there are none.
  const std::vector<double>& ground_stiffness() const { return ground_stiffness_; }
  void add_ground_spring(Index unknown, double stiffness);
  /// Returns whether a ground spring holds an end of the element.
  bool is_grounded(Index element) const;

 private:
  /// Returns whether shear and bending of the element stay intact until it breaks.
  bool keeps_shear(Index element) const { return has_kept_ && network_.law(element).keeps_shear(); }

  const Network& network_;
  const Unknowns* unknowns_;
  std::vector<std::size_t> slot_of_;
  std::vector<std::size_t> moving_slots_;  ///< slots that unknowns move, with embedded particles
  std::vector<double> secants_;
  std::vector<double> axial_;  ///< secants against a change of length; empty if none differs
  bool has_kept_;              ///< Network::has_kept_shear()
  CrackFaces faces_;
  std::vector<UnilateralElement> unilateral_;
  std::vector<double> ground_stiffness_;
};

}  // namespace perilink
