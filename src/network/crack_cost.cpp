#include "network/crack_cost.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

namespace perilink {
namespace {

/// Ratios lambda / mu of the columns. They mean Poisson's ratios of 0, 1/5, 3/10 and 1/3 in plane
/// stress, and of 0, 1/6, 3/13 and 1/4 in plane strain and in space. Bonds without bending have the
/// last ratio.
constexpr std::array<double, 4> lame_ratios = {0.0, 0.5, 6.0 / 7.0, 1.0};

struct CostRow {
  double size;  ///< neighbours of a lattice particle; in unstructured particle sets horizon over
                ///< spacing
  std::array<double, 4> cost;
};

// Means over strips from verification/studies/toughness. Cubic lattices with a horizon of three
// spacings: mean of an endless crack front, 1.080, and a front between free faces, 1.036.
constexpr CostRow rectangular[] = {
    {8, {1.643, 1.887, 2.031, 2.099}},  {12, {1.172, 1.325, 1.663, 1.731}},
    {20, {1.089, 1.142, 1.235, 1.299}}, {24, {1.094, 1.128, 1.190, 1.218}},
    {28, {1.044, 1.074, 1.122, 1.166}}, {36, {1.023, 1.054, 1.100, 1.145}},
    {44, {1.042, 1.099, 1.076, 1.121}}, {48, {1.035, 1.075, 1.057, 1.118}}};
constexpr CostRow hexagonal[] = {
    {12, {1.300, 1.379, 1.526, 1.619}}, {18, {1.131, 1.187, 1.252, 1.308}},
    {30, {1.072, 1.095, 1.137, 1.148}}, {36, {1.044, 1.064, 1.116, 1.100}},
    {42, {1.034, 1.051, 1.106, 1.139}}, {54, {1.050, 1.041, 1.076, 1.111}},
    {60, {1.043, 1.044, 1.053, 1.081}}};
constexpr CostRow cubic[] = {{18, {1.008, 1.140, 1.354, 1.451}},
                             {32, {1.000, 1.047, 1.313, 1.377}},
                             {56, {0.944, 0.987, 1.106, 1.178}},
                             {122, {0.999, 0.996, 1.031, 1.058}}};
constexpr CostRow face_centred[] = {{18, {1.086, 1.216, 1.396, 1.668}},
                                    {42, {1.069, 1.084, 1.131, 1.166}},
                                    {54, {1.043, 1.060, 1.096, 1.109}},
                                    {78, {0.994, 1.029, 1.062, 1.079}},
                                    {176, {1.024, 1.015, 1.025, 1.001}}};
constexpr CostRow unstructured_plane[] = {{2.5, {1.116, 1.165, 1.249, 1.297}},
                                          {3.0, {1.082, 1.109, 1.144, 1.156}}};
// Measured between free faces without bending, 0.93, times 1.02 as for cubic lattices. Bonds with
// bending were not measured.
constexpr CostRow unstructured_space[] = {{3.0, {0.95, 0.95, 0.95, 0.95}}};

std::span<const CostRow> rows_of(Pattern pattern, int dim) {
  switch (pattern) {
    case Pattern::rectangular: return rectangular;
    case Pattern::hexagonal: return hexagonal;
    case Pattern::cubic: return cubic;
    case Pattern::face_centred: return face_centred;
    case Pattern::irregular: break;
  }
  return dim == 2 ? std::span<const CostRow>(unstructured_plane)
                  : std::span<const CostRow>(unstructured_space);
}

/// Interpolates in the table. Below the table it returns the first row. Beyond it the excess over 1
/// falls as size^-power, the inverse of the number of neighbours.
double cost_in(std::span<const CostRow> rows, double size, double power, std::size_t column) {
  const auto above =
      std::find_if(rows.begin(), rows.end(), [&](const CostRow& row) { return row.size >= size; });
  if (above == rows.begin()) return above->cost[column];
  const CostRow& below = *(above - 1);
  const double low = below.cost[column];
  if (above == rows.end()) return 1.0 + (low - 1.0) * std::pow(below.size / size, power);
  const double part = (size - below.size) / (above->size - below.size);
  return low + part * (above->cost[column] - low);
}

}  // namespace

double crack_cost(const Body& body, const NetworkInput& input, const SolidMaterial& material) {
  const Lattice& lattice = body.lattice;
  const bool particle_set = lattice.pattern == Pattern::irregular;
  const std::span<const CostRow> rows = rows_of(lattice.pattern, lattice.dim);
  const double size =
      particle_set
          ? input.horizon / lattice.spacing
          : static_cast<double>(interior_neighbourhood(lattice, input.horizon).offsets.size());
  const LameConstants lame = lame_constants(input, material);
  const double ratio = std::clamp(lame.lambda / lame.mu, lame_ratios.front(), lame_ratios.back());
  std::size_t column = 1;
  while (column + 1 < lame_ratios.size() && lame_ratios[column] < ratio) ++column;
  const double power = particle_set ? lattice.dim : 1.0;
  const double low = cost_in(rows, size, power, column - 1);
  const double high = cost_in(rows, size, power, column);
  const double part =
      (ratio - lame_ratios[column - 1]) / (lame_ratios[column] - lame_ratios[column - 1]);
  return low + part * (high - low);
}

}  // namespace perilink
