#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

#include "io/case/case_file.hpp"
#include "io/text/csv.hpp"
#include "model/from_case/configure.hpp"
#include "problems/program.hpp"

namespace perilink::verification {
namespace {

/// What each element of a run lost.
struct Losses {
  std::vector<double> energy;  ///< dissipated by its events [N mm]
  std::vector<int> events;
};

/// An event dissipates what the column grows by from its row to the next.
Losses losses_of(const CsvTable& history, Index elements) {
  Losses losses{std::vector<double>(static_cast<std::size_t>(elements)),
                std::vector<int>(static_cast<std::size_t>(elements))};
  const auto element = static_cast<std::size_t>(history.column("element"));
  const auto energy = static_cast<std::size_t>(history.column("dissipated_energy"));
  for (std::size_t k = 0; k + 1 < history.rows.size(); ++k) {
    const auto e = static_cast<std::size_t>(history.rows[k][element]);
    losses.energy[e] += history.rows[k + 1][energy] - history.rows[k][energy];
    ++losses.events[e];
  }
  return losses;
}

/// Shares of the energy that were dissipated further than two horizons from the crack: from all
/// bonds that have lost nine tenths of their stiffness and more.
void print_diffuse(const std::string& case_file, const std::string& results) {
  const Model model = build_model(read_case_file(case_file));
  const Network& network = model.network;
  const Losses losses = losses_of(read_csv(results + "/history.csv"), network.num_elements());
  const auto middle = [&](std::size_t e) {
    const auto* a = &network.particles.positions[2 * network.bonds.first[e]];
    const auto* b = &network.particles.positions[2 * network.bonds.second[e]];
    return std::array{0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1])};
  };
  std::vector<std::array<double, 2>> crack;
  for (std::size_t e = 0; e < losses.events.size(); ++e) {
    const int segment = losses.events[e];
    if (segment > 0 && network.law(static_cast<Index>(e)).segment(segment).secant <= 0.1) {
      crack.push_back(middle(e));
    }
  }
  double all = 0.0, beyond_one = 0.0, beyond_two = 0.0;
  for (std::size_t e = 0; e < losses.energy.size(); ++e) {
    if (losses.events[e] == 0) continue;
    const auto at = middle(e);
    double nearest = INFINITY;
    for (const auto& point : crack) {
      nearest = std::min(nearest, std::hypot(point[0] - at[0], point[1] - at[1]));
    }
    all += losses.energy[e];
    if (nearest > model.horizon) beyond_one += losses.energy[e];
    if (nearest > 2.0 * model.horizon) beyond_two += losses.energy[e];
  }
  fmt::print(
      "dissipated {:.1f}, of it {:.4f} beyond one and {:.4f} beyond two horizons from {} bonds of "
      "the crack\n",
      all, beyond_one / all, beyond_two / all, crack.size());
}

}  // namespace
}  // namespace perilink::verification

/// l_panel CASE.toml RESULTS: how much of the energy a run of the case dissipated away from the
/// crack.
bool perilink::verification::run_program(const std::vector<std::string>& arguments) {
  if (arguments.size() != 2) {
    throw std::invalid_argument("name a case and the directory of its results");
  }
  print_diffuse(arguments[0], arguments[1]);
  return true;
}
