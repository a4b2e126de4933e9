#pragma once

#include <string>
#include <vector>

namespace perilink::verification {

/// A figure of a run beside what it is compared with.
struct Finding {
  std::string part, body, quantity;
  double measured = 0.0, reference = 0.0;
  double allowed = 0.0;  ///< relative difference; zero: told only
};
using Findings = std::vector<Finding>;

/// The parts of the study. Each runs its cases and leaves its pictures in this folder.
Findings bend_on_four_points();
Findings push_cantilever();
Findings pull_tension_members();
Findings pull_bar_out();
Findings crush_over_reinforced();
Findings shear_short_beams();
Findings bend_measured_beam();

}  // namespace perilink::verification
