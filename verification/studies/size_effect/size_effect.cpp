#include "size_effect.hpp"

#include <algorithm>
#include <cmath>

#include "bar.hpp"

namespace perilink::verification {

std::array<double, 4> differences(const NeighbourhoodRow& row) {
  return {row.found.e1 - row.exact.e1, row.found.e2 - row.exact.e2, row.found.nu12 - row.exact.nu12,
          row.found.nu2 - row.exact.nu2};
}

std::array<double, 4> largest_differences(const std::vector<NeighbourhoodRow>& rows) {
  std::array<double, 4> largest{};
  for (const NeighbourhoodRow& row : rows) {
    const auto own = differences(row);
    for (std::size_t k = 0; k < own.size(); ++k) {
      largest[k] = std::max(largest[k], std::abs(own[k]));
    }
  }
  return largest;
}

std::vector<NeighbourhoodRow> compare_neighbourhoods(const NeighbourhoodInput& input) {
  const auto stiffness = neighbourhood_stiffness(input);
  std::vector<NeighbourhoodRow> rows;
  for (std::size_t n = 0; n < input.poissons_ratios.size(); ++n) {
    const double ratio = input.poissons_ratios[n];
    const MicropolarModuli moduli = continuum_micropolar(input.problem, {1.0, ratio}, 1.0, 1.0);
    for (std::size_t r = 0; r < input.rows.size(); ++r) {
      const double depth = static_cast<double>(input.rows[r]) / input.horizon_ratio;
      rows.push_back(
          {ratio, depth, layer_moduli(input.problem, stiffness[r][n]),
           layer_moduli(input.problem, layer_stiffness(input.problem, moduli, 1.0, depth))});
    }
  }
  return rows;
}

BarRow compare_bar(int width, int horizon_ratio, double poissons_ratio, bool calibrated) {
  constexpr Problem problem = Problem::plane_stress;
  const MicropolarModuli moduli = continuum_micropolar(problem, {1.0, poissons_ratio}, 1.0, 1.0);
  BarRow row{width, horizon_ratio};
  row.uncorrected = apparent_modulus({width, horizon_ratio, poissons_ratio, Surface::none});
  row.neighbourhoods =
      layer_moduli(problem, plate_of_neighbourhoods(problem, horizon_ratio, width * horizon_ratio,
                                                    poissons_ratio))
          .e2;
  row.exact = layer_moduli(problem, plate_stiffness(problem, moduli, 1.0, width)).e2;
  row.calibrated =
      calibrated ? apparent_modulus({width, horizon_ratio, poissons_ratio, Surface::calibrated})
                 : std::nan("");
  return row;
}

}  // namespace perilink::verification
