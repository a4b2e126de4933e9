#pragma once

#include "app/compare/run_result.hpp"
#include "app/plot/svg.hpp"

namespace perilink {

/// Load over displacement of two results with their peaks, signs as in the histories; beyond 200
/// rows a curve is its envelope, over its rows in a pale line, unless they follow time. The legend
/// above the frame has the names of the directories and the titles of the cases.
Svg draw_comparison(const RunResult& a, const RunResult& b);

}  // namespace perilink
