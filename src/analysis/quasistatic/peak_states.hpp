#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "analysis/quasistatic/load_curve.hpp"
#include "analysis/quasistatic/observer.hpp"

namespace perilink {

/// Copies of the states with the largest |load| so far. Which of them is the peak is known at the
/// end of a run only, since a later and larger load may be residual strength. A copy is cheap
/// beside an event: it holds displacements and the stiffness of damaged elements.
class PeakStates {
 public:
  /// A row with its state.
  struct State {
    StepRecord row;
    std::vector<double> displacement;  ///< StateSource::unsolved_state()
    /// Ratios of the first elements of the list of damaged elements; `axial` is empty if it does
    /// not differ.
    std::vector<double> secants, axial;
    std::vector<std::uint8_t> whole;  ///< StepState::whole
    double lowest = 0.0;              ///< smallest |load| of the rows since

    template <class Archive>
    void serialize(Archive& archive) {
      archive(row, displacement, secants, axial, whole, lowest);
    }
  };

  /// Adds a row. A state is kept if the load has fallen before a larger one came.
  /// \param by_events  the record names all elements that fail at its load
  void add(const StepRecord& record, StateSource& source, bool by_events);

  /// Forgets the states: the rows to come have another load case.
  void clear() { states_.clear(); }

  /// Returns the state of the row with a peak, with its sign ignored; null if it was not kept.
  const State* find(const CurvePoint& peak) const;
  /// Returns the state with the largest |load|; null if there is none.
  const State* highest() const { return states_.empty() ? nullptr : &states_.back(); }

  /// Secant stiffness ratios of all elements.
  struct Ratios {
    std::vector<double> secants, axial;
    operator Secants() const { return axial.empty() ? Secants(secants) : Secants(secants, axial); }
  };
  Ratios ratios(const State& state, Index num_elements) const;

  template <class Archive>
  void serialize(Archive& archive) {
    archive(damaged_, failing_, states_);
  }

 private:
  void note_damaged(std::span<const Index> elements);
  void note_all_damaged(Secants secants);

  std::vector<Index> damaged_;            ///< elements with less than their stiffness, so far
  std::vector<std::uint8_t> is_damaged_;  ///< per element, of damaged_; empty: to be made
  std::vector<Index> failing_;            ///< elements that fail at the load of the last row
  std::vector<State> states_;             ///< by ascending |load|; the last is the largest so far
};

}  // namespace perilink
