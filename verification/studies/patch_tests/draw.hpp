#pragma once

#include <vector>

#include "app/plot/svg.hpp"
#include "patch.hpp"

namespace perilink::verification {

/// Residual and errors of every body on a logarithmic axis, bond-based and micropolar side by side.
Svg draw_residuals(const std::vector<PatchResult>& results);

}  // namespace perilink::verification
