#pragma once

#include <vector>

#include "app/plot/svg.hpp"
#include "table1.hpp"

namespace perilink::verification {

/// Errors over the number of columns: printed ones as circles, found ones as lines.
Svg draw_table(const std::vector<TableRow>& rows);

}  // namespace perilink::verification
