#pragma once

namespace perilink {

/// Factors that make_factor has made in this process: tests count those that nobody needs.
int factors_made();

}  // namespace perilink
