#pragma once

namespace perilink::verification {

/// Compares and times blocks whose bonds soften, bond-based and micropolar, beside brittle ones,
/// and writes result_softening.csv or, large, result_softening_50k.csv.
/// \return whether all meet the acceptance
bool run_softening(bool large);

}  // namespace perilink::verification
