#pragma once

#include <vector>

#include "analysis/dynamics/lattice/body/lattice_state.hpp"
#include "analysis/dynamics/lattice/ranks/row_partition.hpp"
#include "analysis/dynamics/meetings.hpp"

namespace perilink {

/// How a rank takes part in an explicit run of a lattice. It moves its own rows; of the rows around
/// them it knows as many as all stages of a step reach, and does with these what their owners do.
/// Where rows there depend on others that it does not know they come from their owners, once in
/// every step. In meetings the first rank, whose numbers are those of the body, takes the sums of
/// all rows.
class LatticeShare {
 public:
  /// \param model   the rank's own, which has to outlive this
  /// \param own_of  own rows of all ranks that take part; the first rank's only
  LatticeShare(Ranks& ranks, const RowPart& part, const ExplicitModel& model,
               std::vector<RowRange> own_of = {});

  bool leads() const { return meetings_.ranks().leads(); }
  const RowPart& part() const { return part_; }

  /// Between steps: rows of other ranks become what they are there.
  void update_rows(ExplicitState& state);
  /// Once in every step.
  void note_step(const ExplicitState& state) {
    meetings_.note_step(held_rows_, [&](Index r) { return state.reactions[r].supports; });
  }

  /// The first rank's meeting begins, or its last step is done: takes the sums of all rows.
  /// \return reactions of supports in each step since the last time [force]
  std::vector<double> collect(ExplicitState& state);
  /// During a meeting: motion and fields of all particles.
  void collect_fields(ExplicitState& state);
  /// Ends a meeting.
  void tell(bool goes_on) { meetings_.tell(goes_on); }

  /// A meeting of the others. \return whether the run goes on
  bool meet(const ExplicitState& state);
  /// The last step of the others is done.
  void report(const ExplicitState& state);

 private:
  /// Rows that a neighbour knows of this rank and this of it.
  struct Border {
    RowRange out, in;
  };

  const ExplicitModel& model_;
  RowPart part_;
  Meetings meetings_;
  std::vector<RowRange> own_of_;
  std::vector<Index> held_rows_;
  std::vector<Border> borders_;
  std::vector<Exchange> messages_;  ///< one for each border
};

}  // namespace perilink
