#pragma once

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <functional>
#include <span>
#include <vector>

#include "analysis/quasistatic/equilibrium/body/crack_faces.hpp"
#include "analysis/quasistatic/equilibrium/body/event_outcome.hpp"
#include "network/loaded_network.hpp"

/// \file
/// Reference of damage analyses, for small bodies. It assembles a dense stiffness matrix from
/// textbook elements and solves it completely at every event. It has no factor updates, no partial
/// displacements and no cheap checks, and shares no solver or search with the program.

namespace perilink::test {

/// Next event of a body by exhaustive search.
struct ReferenceEvent {
  std::vector<Index> elements;    ///< elements that may be the event's, ascending; empty: no event
  double load_factor = 0.0;       ///< load factor of the event
  bool at_constant_load = false;  ///< an element is beyond its limit at the present load factor
  bool changes_side = false;      ///< a damaged bond closes or opens, and no element fails
  double direction = 1.0;         ///< of a contact state change: -1 if the load factor falls
};

/// Damage analysis of trusses and micropolar bonds of one modulus ratio each, with bars, elastic
/// supports, embedded particles, closing bonds and load cases.
class ReferenceEngine {
 public:
  /// Relative difference within which candidates for an event tie: tie_tolerance and round-off.
  static constexpr double tie = 1e-9;

  /// \param body       must outlive this object
  /// \param tolerance  EquilibriumOptions::event_tolerance
  /// \throws std::invalid_argument for bodies beyond its scope
  explicit ReferenceEngine(const LoadedNetwork& body, double tolerance = 0.0);

  /// Starts a stage of a body with load cases, see StagedEngine::begin_stage().
  void begin_stage(std::size_t set);
  /// Sets the contact states for the first loads of a stage. \return false for a mechanism
  bool open_for(double direction) { return settle(direction); }
  void move_to(double load_factor) {
    load_factor_ = load_factor;
    largest_factor_ = std::max(largest_factor_, std::abs(load_factor));
  }
  double load_factor() const { return load_factor_; }

  /// Finds the next event: without load cases as the load grows from zero, else at the largest load
  /// factor at which all elements are within their limits.
  ReferenceEvent next_event() const;
  /// Finds the next event on the way from the present load factor to `target`.
  ReferenceEvent next_event_towards(double target) const;

  /// Stretch of an element over its next limit at load factor 1, or at a load factor of a stage.
  double ratio(Index element) const { return ratio(element, growing_); }
  double ratio_at(double load_factor, Index element) const {
    return ratio(element, displacement_at(load_factor));
  }
  /// Weakens elements at once. If that separates the body, nothing changes.
  EventOutcome apply(std::span<const Index> elements);
  /// Weakens elements one after the other, up to a mechanism.
  EventOutcome apply_in_turn(std::span<const Index> elements);
  /// Changes the contact states of bonds with zero extension for a load that grows or falls.
  EventOutcome pass_side_change(double direction);
  /// Changes how particles move. \return growth of the compliance, see Freedom
  Freedom change_motion(const Unknowns& unknowns);
  void set_release_threshold(std::span<const Index> elements, double fraction);

  /// Work products at load factor 1, with those of permanent loads.
  LoadWork work() const;
  double stored_energy() const;
  /// Displacements of all particles by the growing loads, or all loads at a load factor, shape
  /// (particles, width).
  const Eigen::VectorXd& growing() const { return growing_; }
  Eigen::VectorXd displacement_at(double load_factor) const {
    return constant_ + load_factor * growing_;
  }
  Secants secants() const { return {secants_, axial_}; }
  /// Whether a particle has a motion without stiffness.
  bool is_loose(Index particle) const;
  bool has_loose_parts() const { return loose_.cols() > 0; }
  /// Whether a bond's extension is large enough to have a contact state.
  bool has_side(Index element) const;

 private:
  /// Extended precision, so that the condition of a body takes no digits that count.
  using Fine = Eigen::MatrixX<long double>;
  using FineVector = Eigen::VectorX<long double>;
  struct Field {
    std::vector<double> forces, prescribed;  ///< shape (particles, width)
  };
  /// Product that depends on the load factor, `square` lambda^2 + linear lambda + constant.
  struct Parabola {
    double square = 0.0;
    Beside rest;
  };
  Parabola parabola(const std::function<double(double load_factor)>& value) const;

  void weaken(Index element);
  bool solve();
  Fine restricted(const Fine& matrix) const;
  Fine expanded(const Fine& matrix) const;
  bool settle(double direction);
  void set_closed_ratios(const std::vector<Index>& broken, const std::vector<Index>& opened);
  bool change_some(const std::vector<Index>& wrong);
  std::vector<Index> violated(double direction) const;
  bool is_closed(Index element) const { return axial_[element] > secants_[element]; }
  bool can_close(Index element) const;
  void turn(Index element) {
    axial_[element] = is_closed(element) ? secants_[element] : closed_[element];
  }
  double compliance_at(double load_factor) const;
  double energy_of(Index element, double axial, double rest, double load_factor) const;
  EventOutcome finish(EventOutcome outcome, const Parabola& before) const;

  // Search: reference_search.cpp.
  bool is_frame(Index element) const {
    return network_.carries_moments() && network_.bending[element] > 0.0;
  }
  double limit_of(Index element) const;
  double allowed(Index element) const;
  double ratio(Index element, const Eigen::VectorXd& motion) const;
  double extension(Index element, const Eigen::VectorXd& motion) const;
  double squared_stretch(Index element, const Eigen::VectorXd& motion) const;
  std::vector<double> crossings(Index element) const;
  std::vector<double> all_crossings() const;
  bool is_admissible(double load_factor) const;
  ReferenceEvent worst() const;
  ReferenceEvent failing_at(double load_factor, double direction) const;
  ReferenceEvent or_side_change(ReferenceEvent event, double end) const;

  const LoadedNetwork& body_;
  const Network& network_;
  double tolerance_;
  Unknowns unknowns_;
  Field growing_loads_, constant_loads_;
  double load_factor_ = 1.0, largest_factor_ = 1.0;
  std::vector<double> factors_, gripped_at_;
  std::size_t set_ = 0, newest_ = 0;
  std::vector<int> segments_;
  std::vector<double> secants_, axial_, closed_, threshold_;
  std::vector<Index> newly_broken_;
  std::vector<std::uint8_t> active_;  ///< per particle: its compressive branches are active
  Fine stiffness_;                    ///< of all slots, with elastic supports
  Eigen::MatrixXd loose_;             ///< motions of all slots without stiffness, one per column
  Eigen::VectorXd growing_, constant_;
  FineVector growing_forces_, constant_forces_;  ///< stiffness times displacements
};

}  // namespace perilink::test
