#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "analysis/dynamics/explicit_run.hpp"
#include "analysis/quasistatic/observer.hpp"
#include "io/case/case_file.hpp"

/// \file
/// Quantities of the rows of a history. A further quantity is a member of its row and a line of a
/// table in history_columns.cpp; files, readers, units, reports and Python follow.

namespace perilink {

/// Column of a history.csv.
struct HistoryColumn {
  /// Cases with the column.
  enum class In { all, stages, elements, batches, breaking_bonds, cracking_particles };

  const char* name;
  const char* unit;  ///< of force F, length L and time T, as "F L"; empty: none
  const char* meaning;
  bool counts = false;         ///< holds whole numbers
  bool begins_at_zero = true;  ///< zero in the undeformed body
  In in = In::all;

  bool is_shown(const CaseFile& input) const;
};

/// Column of rows of one type.
template <class Row>
struct RowColumn : HistoryColumn {
  double (*get)(const Row&) = nullptr;
  void (*set)(Row&, double) = nullptr;  ///< null: is not read

  constexpr RowColumn only_in(In cases) const {
    RowColumn column = *this;
    column.in = cases;
    return column;
  }
  constexpr RowColumn not_from_zero() const {
    RowColumn column = *this;
    column.begins_at_zero = false;
    return column;
  }
};

/// Returns the columns of quasistatic histories, in the order of history.csv.
std::span<const RowColumn<StepRecord>> columns_of(const StepRecord&);
/// Returns the columns of histories over time, in the order of history.csv.
std::span<const RowColumn<ExplicitRecord>> columns_of(const ExplicitRecord&);

/// Returns the columns of the history of a case, without gauges.
std::vector<std::string> history_columns(const CaseFile& input);

/// Returns the standard column of that name of some analysis type; null: a gauge.
const HistoryColumn* find_history_column(std::string_view name);

}  // namespace perilink
