#pragma once

#include <vector>

#include "analysis/dynamics/lattice/body/lattice_body.hpp"
#include "analysis/dynamics/lattice/rows/row_sweep.hpp"
#include "base/parcel.hpp"

namespace perilink {

/// Rows [begin, end).
struct RowRange {
  Index begin = 0, end = 0;

  Index size() const { return end - begin; }
  RowRange moved(Index by) const { return {begin + by, end + by}; }
};

/// What a rank does with the rows of a lattice. Numbers of rows are its own.
struct RowPart {
  RowRange own;     ///< that it moves
  SweptRows swept;  ///< that it works on: from the rows around its own ones follow these alone
  RowRange to_before, to_after;      ///< own rows that the ranks before and after it know
  RowRange from_before, from_after;  ///< rows of theirs that it knows; empty where there is no rank
};

/// Which rows of a lattice each rank moves: consecutive ones, as many particles and gaps as the
/// others.
class RowPartition {
 public:
  /// \param reach  that all stages of a step have together
  /// \param ranks  how many there are: fewer take part, or one alone, where rows are too few for
  ///               each to have as many of its own as it would have from others
  RowPartition(const LatticeRows& lattice, const SweepReach& reach, int ranks);

  int count() const { return static_cast<int>(first_.size()) - 1; }
  RowRange own(int rank) const { return {first_[rank], first_[rank + 1]}; }
  /// Rows that a rank knows: all that its own ones in the next step depend on.
  RowRange known(int rank) const;
  RowPart part(int rank) const;

 private:
  Index rows_;
  Index before_, after_;      ///< rows of others in a sweep, before the own ones and after them
  Index partners_;            ///< rows beyond these where their bonds end
  std::vector<Index> first_;  ///< own row of each rank, and an end
};

/// The body of a rank that knows some of the rows, without positions. Slots keep their distances.
ExplicitModel cut_rows(const ExplicitModel& model, RowRange rows);
/// The same part of a field of shape (any, slots).
std::vector<double> cut_field(const std::vector<double>& field, const LatticeRows& lattice,
                              RowRange rows);

void pack(const ExplicitModel& model, Parcel& parcel);
ExplicitModel unpack_model(Parcel& parcel);

}  // namespace perilink
