#pragma once

#include "app/run/run_files.hpp"
#include "app/run/run_warnings.hpp"
#include "app/run/summary.hpp"

namespace perilink {

/// What only some bodies that move have.
struct MotionExtras {
  double fundamental_period = 0.0;     ///< 0: nothing asks for it [time]
  bool yields = false;                 ///< particles flow
  nlohmann::ordered_json constants{};  ///< how well those of state-based particles were found
};

/// What explicit runs tell, of bonds and of lattices, but for the sizes of their bodies.
void tell_motion(Summary& summary, const CaseFile& input, const RunFiles& files,
                 const ExplicitResult& result, const MotionExtras& extras);

}  // namespace perilink
