#include "network/builder/repeated_box.hpp"

#include <algorithm>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "network/element_columns.hpp"
#include "network/lattice_pattern.hpp"

namespace perilink {
namespace {

/// Smallest ratio of particles, body over template box, for which the template saves time.
constexpr double enough = 2.0;

bool is_uniform(const Body& body, const NetworkInput& input) {
  const std::vector<Index>& material = body.particles.material;
  const LameConstants first = lame_constants(input, input.materials[material.front()]);
  std::vector<std::uint8_t> same;
  for (const SolidMaterial& m : input.materials) same.push_back(lame_constants(input, m) == first);
  return std::ranges::all_of(material, [&](Index m) { return same[m] != 0; });
}

/// Returns the pattern without its template network.
std::optional<LatticePattern> find_pattern(const Body& body, const NetworkInput& input) {
  const bool can_repeat = body.particles.dim == 3 && body.lattice.surface == Surface::calibrated &&
                          !input.shell && input.interfaces.empty();
  if (!can_repeat) return std::nullopt;
  const std::optional<LatticeGrid> grid = grid_of(body);
  if (!grid || !is_uniform(body, input)) return std::nullopt;
  LatticePattern pattern = pattern_of(*grid, input.horizon);
  const double particles = enough * pattern.small.size(pattern.small.all());
  return body.particles.size() < particles ? std::nullopt : std::optional(std::move(pattern));
}

/// Returns the values of the template bonds equivalent to the bonds of the body.
template <class Value>
std::vector<Value> repeated(const std::vector<Value>& values, std::span<const Index> like) {
  std::vector<Value> result;
  if (values.empty()) return result;
  result.reserve(like.size());
  for (const Index element : like) result.push_back(values[element]);
  return result;
}

}  // namespace

bool repeats_smaller_box(const Body& body, const NetworkInput& input) {
  return find_pattern(body, input).has_value();
}

std::optional<Network> repeat_smaller_box(
    const Body& body, const NetworkInput& input,
    const std::function<Network(const Body& body, const NetworkInput& input)>& make) {
  std::optional<LatticePattern> pattern = find_pattern(body, input);
  if (!pattern) return std::nullopt;
  NetworkInput small_input = input;
  if (!input.is_draft()) small_input.calibrating = Calibrating::only_alike;
  small_input.cracks.clear();
  small_input.solid = {{pattern->small.lower, pattern->small.upper}};
  Body small = body_of(pattern->small, body.lattice, input.thickness);
  std::ranges::fill(small.particles.material, body.particles.material.front());
  pattern->sample = make(small, small_input);
  share_directions(pattern->sample.bonds);
  const Network& sample = pattern->sample;
  if (!input.is_draft() && !sample.report.calibration->alike) return std::nullopt;

  Network network;
  network.particles = body.particles;
  network.facets = body.facets;
  network.report.calibration = sample.report.calibration;
  if (network.report.calibration) network.report.calibration->alike = true;
  network.torsion = sample.torsion;
  const LatticeGrid& grid = pattern->grid;
  std::vector<Index> like;
  const auto count = static_cast<std::size_t>(pattern->num_bonds());
  network.bonds.begin_alike(sample.bonds, count);
  like.reserve(count);
  PatternBonds(*pattern).for_each(
      [&](const GridPoint& first, const GridPoint& second, Index element) {
        network.bonds.append_alike(grid.number(grid.all(), first), grid.number(grid.all(), second),
                                   sample.bonds.kind_of(element));
        like.push_back(element);
      });
  for_each_element_column([&](auto list, auto) { list(network) = repeated(list(sample), like); });
  return network;
}

}  // namespace perilink
