#include "app/field_file.hpp"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "assembly/fields.hpp"

namespace perilink {
namespace {

/// Rows of `dim` numbers as rows of three, as VTK wants vectors.
std::vector<double> padded_to_three(std::span<const double> values, int dim) {
  const std::size_t width = static_cast<std::size_t>(dim);
  std::vector<double> padded(values.size() / width * 3, 0.0);
  for (std::size_t k = 0; k < values.size(); ++k) padded[k / width * 3 + k % width] = values[k];
  return padded;
}

template <class T>
std::vector<double> as_doubles(const std::vector<T>& values) {
  std::vector<double> numbers(values.size());
  std::transform(values.begin(), values.end(), numbers.begin(),
                 [](T value) { return static_cast<double>(value); });
  return numbers;
}

void append_cell(VtuGrid& grid, VtuCell type, std::initializer_list<Index> points,
                 FieldElement element, double broken_at) {
  grid.types.push_back(type);
  grid.connectivity.insert(grid.connectivity.end(), points);
  grid.offsets.push_back(static_cast<Index>(grid.connectivity.size()));
  grid.cell_data[0].values.push_back(static_cast<double>(element));
  grid.cell_data[1].values.push_back(broken_at);
}

void append_cells(VtuGrid& grid, const Network& network, std::span<const Index> broken_elements) {
  grid.cell_data = {{"element", 1, {}}, {"broken_at", 1, {}}};
  for (Index i = 0; i < network.particles.size(); ++i) {
    append_cell(grid, VtuCell::vertex, {i}, FieldElement::particle, 0.0);
  }
  const auto ends = [&](Index b) {
    return std::pair(network.bonds.first[b], network.bonds.second[b]);
  };
  double broken_at = 0.0;
  for (const Index b : broken_elements) {
    const auto [i, j] = ends(b);
    append_cell(grid, VtuCell::line, {i, j}, FieldElement::broken_bond, broken_at += 1.0);
  }
  for (Index b = network.first_segment; b < network.num_elements(); ++b) {
    const auto [i, j] = ends(b);
    append_cell(grid, VtuCell::line, {i, j}, FieldElement::rebar_segment, 0.0);
  }
}

}  // namespace

VtuGrid make_field_grid(const Network& network, const StepState& state, const StepRecord& record,
                        std::span<const Index> broken_elements_in_order, const Csr& families,
                        double spacing) {
  const int dim = network.dim();
  std::vector<double> motion(state.displacement.begin(), state.displacement.end());
  for (double& u : motion) u *= record.load_factor;
  const std::vector<double> displacement = translations(network, motion);

  VtuGrid grid;
  grid.points = padded_to_three(network.particles.positions, dim);
  append_cells(grid, network, broken_elements_in_order);
  grid.point_data = {
      {"displacement", 3, padded_to_three(displacement, dim)},
      {"damage", 1, damage_index(network, families, state.secants)},
      {"region", 1, as_doubles(network.particles.material)},
      {"kind", 1, as_doubles(network.particles.kind)},
      {"strain_energy_density", 1,
       strain_energy_density(network, families, state.secants, motion)},
      {"principal_strain", 3,
       padded_to_three(principal_strains(network, families, state.secants, displacement), dim)},
  };
  if (network.carries_moments()) {
    grid.point_data.push_back({"rotation", dim == 2 ? 1 : 3, rotations(network, motion)});
  }
  grid.field_data = {
      {"step", static_cast<double>(record.step)},
      {"broken_bonds", static_cast<double>(record.broken_bonds)},
      {"load_factor", record.load_factor},
      {"load", record.load},
      {"dimension", static_cast<double>(dim)},
      {"spacing", spacing},
  };
  return grid;
}

}  // namespace perilink
