#include "app/run_doubts.hpp"

#include <fmt/format.h>

#include <cmath>

namespace perilink {

std::vector<std::string> doubts_about(const ExplicitResult& result, double peak_load) {
  constexpr double most_surplus = 0.01, most_difference = 0.05;
  std::vector<std::string> doubts;
  if (result.largest_surplus > most_surplus) {
    doubts.push_back(
        fmt::format("energy appeared from nothing or vanished, up to {:.2g} % of the work: forces "
                    "and losses of these rules belong to no energy, or the step is too large",
                    100.0 * result.largest_surplus));
  }
  const double load = std::abs(peak_load), reaction = std::abs(result.peak_load);
  // Supports that hold nothing but symmetry feel next to nothing of the load.
  const bool carries = reaction > 0.5 * load && load > 0.0;
  const double difference = std::abs(load - reaction);
  if (carries && difference > most_difference * reaction) {
    doubts.push_back(
        fmt::format("the peaks of load and reaction differ by {:.2g} %: inertia, or damping of the "
                    "motion by mass, is in the load; load more slowly, damp less, or read the "
                    "reaction",
                    100.0 * difference / reaction));
  }
  return doubts;
}

std::vector<std::string> doubts_about(const DamageResult& result) {
  // Results are printed with six digits; equilibria are exact but for round-off, which leaves ten.
  constexpr double most_imbalance = 1e-6;
  std::vector<std::string> doubts;
  // Written so that what is not a number is in doubt too.
  if (!(result.energy_error <= most_imbalance)) {
    doubts.push_back(
        fmt::format("work and energies are out of balance, up to {:.2g} of the work: the body is "
                    "so compliant that round-off has reached its results",
                    result.energy_error));
  }
  if (!(result.largest_residual <= most_imbalance)) {
    doubts.push_back(
        fmt::format("up to {:.2g} of the load is out of balance: the stiffness matrix is so close "
                    "to singular that displacements are not solved for to six digits",
                    result.largest_residual));
  }
  return doubts;
}

}  // namespace perilink
