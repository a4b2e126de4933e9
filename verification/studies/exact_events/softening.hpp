#pragma once

namespace perilink::verification {

/// Compares and times blocks whose bonds soften, bond-based and micropolar, beside brittle ones,
/// and writes result_softening.csv.
/// \return whether all meet the acceptance
bool run_softening();

}  // namespace perilink::verification
