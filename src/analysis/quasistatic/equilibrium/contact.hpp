#pragma once

#include <span>
#include <vector>

#include "analysis/quasistatic/equilibrium/displacement/solution.hpp"

namespace perilink {

/// Extension at the present load factor, and its parts from growing and permanent loads [length].
struct Extension {
  double now = 0.0, growing = 0.0, constant = 0.0;
  double side = 0.0;  ///< negative: in compression, or about to be
};

/// How unilateral elements are read: the sign of the load change decides for elements with zero
/// extension, and some extensions are round-off.
struct Reading {
  double direction = 0.0;  ///< 1 if the load factor grows, -1 if it falls, 0 if it stays
  double noise = 0.0;      ///< extensions below this have no contact state [length]
};

/// Which contact states of unilateral elements a solution violates, and when the next one changes.
/// Reads the body and its displacements, and changes nothing.
class Contact {
 public:
  explicit Contact(const Solution& solution) : body_(solution.body()), solution_(solution) {}

  Extension extension_of(Index element, const Reading& reading = {}) const;
  /// Returns violated elements: closed ones in tension and open ones in compression.
  std::vector<Index> violated(const Reading& reading) const;

  /// Contact state change as the load factor of a stage moves, and the distance of the load factor
  /// to it.
  struct Change {
    Index element = no_index;
    double distance = 0.0;
  };
  /// Returns the first change.
  /// \param distance  largest change of the load factor, with its sign; may be infinite
  Change next_change(double distance) const;

  /// Returns the open element that a motion of all particles closes first; no_index: none closes.
  Index first_closed_by(std::span<const double> motion) const;

  /// Returns the motion of all particles that decides the contact states. It is the present one, or
  /// the one of growing loads if only elements with zero extension may change.
  std::vector<double> deciding_motion(const Reading& reading) const;
  /// Returns the elements that a deciding motion violates.
  std::vector<Index> violated_by(std::span<const double> motion, const Reading& reading) const;
  /// Returns the fraction of the way between two deciding motions at which the energy is least. The
  /// second is the equilibrium of the present contact states.
  double line_minimum(std::span<const double> from, std::span<const double> to,
                      const Reading& reading) const;
  /// Returns the round-off of extensions in a motion [length].
  double round_off_of(std::span<const double> motion) const;

 private:
  struct View;
  View view(const Reading& reading) const;
  template <class Visit>
  void for_each(const Reading& reading, Visit visit) const;
  std::vector<double> extensions(std::span<const double> motion, const Reading& reading) const;

  const DamagedBody& body_;
  const Solution& solution_;
};

/// Search for contact states. The energy is convex and has one minimum; changing the states of
/// violated elements finds it. All of them change together, usually for one or two rounds. After
/// that, line searches follow the energy down, each on the way to the equilibrium of the present
/// states. Extensions within the round-off of the whole motion then have no contact state.
/// Otherwise, bodies that an event has cut through and unloaded would never settle.
class ContactRounds {
 public:
  /// \param direction  see Reading
  ContactRounds(const Contact& contact, double direction)
      : contact_(contact), direction_(direction) {}

  /// Returns the elements whose contact states must change next, before another equilibrium; none
  /// if the states are right.
  /// \throws SolverError if the states do not settle
  std::vector<Index> next();

 private:
  const Contact& contact_;
  double direction_;
  int round_ = 0;
  std::vector<double> reached_;  ///< end of the line searches so far
};

}  // namespace perilink
