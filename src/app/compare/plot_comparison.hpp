#pragma once

#include "app/compare/run_result.hpp"
#include "app/plot/svg.hpp"

namespace perilink {

/// Draws load over displacement of two results with their peaks; signs are as in the histories.
/// Above 200 rows a damage curve is drawn as its envelope over the pale rows. The legend above the
/// frame gives directory names and case titles.
Svg draw_comparison(const RunResult& a, const RunResult& b);

}  // namespace perilink
