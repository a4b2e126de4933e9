#include "compare.hpp"

#include <algorithm>
#include <cmath>

#include "problems/block.hpp"

namespace perilink::verification {

Agreement compare_routes(const Model& model, FactorRoute other, Index events, Index other_events,
                         std::size_t rows, std::size_t other_rows) {
  const BlockRun ours =
      run_block(model, FactorRoute::in_place, events, 1, DamageOptions{}.check_interval, rows);
  // Refined after every event: a fresh factor alone leaves the condition number times round-off.
  const BlockRun reference = run_block(model, other, other_events, 1, 1, other_rows);
  Agreement agreement;
  agreement.unknowns = model.unknowns.count;
  agreement.events = ours.result.broken_bonds;
  agreement.rows = static_cast<Index>(ours.rows.size());
  agreement.termination = to_string(ours.result.termination);
  agreement.energy_error = ours.result.energy_error;
  agreement.largest_residual = ours.result.largest_residual;
  agreement.factorizations = ours.result.factor.factorizations;
  agreement.seconds = ours.seconds;
  agreement.seconds_per_event = ours.seconds_per_event;
  agreement.other_seconds = reference.seconds;
  agreement.compared = static_cast<Index>(std::min(ours.rows.size(), reference.rows.size()));
  for (Index k = 0; k < agreement.compared; ++k) {
    if (ours.rows[k].element != reference.rows[k].element) ++agreement.mismatches;
    const double expected = reference.rows[k].load_factor;
    agreement.load_factor_difference =
        std::max(agreement.load_factor_difference,
                 std::abs(ours.rows[k].load_factor - expected) / std::abs(expected));
  }
  // A reference that ended earlier by itself (collapse) must end at the same event.
  const Termination termination = reference.result.termination;
  const bool by_itself =
      termination != Termination::completed && termination != Termination::interrupted;
  if (by_itself && ours.rows.size() != reference.rows.size()) {
    ++agreement.mismatches;
  }
  return agreement;
}

}  // namespace perilink::verification
