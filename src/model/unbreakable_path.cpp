#include "model/unbreakable_path.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <span>
#include <utility>
#include <vector>

#include "base/joined_parts.hpp"
#include "io/case/case_words.hpp"
#include "model/model_regions.hpp"

namespace perilink {
namespace {

/// A region with supports or loads.
struct Place {
  std::string name;
  std::vector<Index> particles;
  bool moves = false;  ///< has loads or prescribed displacements
};

/// Returns the corners of the facets in a region.
std::vector<Index> corners_in(const CaseFile& input, const Model& model, const std::string& region,
                              const std::string& key) {
  std::vector<Index> corners;
  for (const Index facet : facets_of_region(input, model, region, key)) {
    const std::span<const Index> row = model.facets.corners.row(facet);
    corners.insert(corners.end(), row.begin(), row.end());
  }
  return corners;
}

bool is_driven(const DisplacementSection& section) {
  return std::ranges::any_of(section.value,
                             [](const auto& value) { return value && !value->is_zero(); });
}

std::vector<Place> places_of(const CaseFile& input, const Model& model) {
  std::vector<Place> places;
  const auto add_all = [&](const char* table, const auto& sections, auto moves, auto on_facets) {
    for (std::size_t k = 0; k < sections.size(); ++k) {
      const std::string& region = sections[k].region;
      const auto particles_in = on_facets(sections[k]) ? corners_in : particles_of_region;
      places.push_back({region, particles_in(input, model, region, item_key(table, k, "region")),
                        moves(sections[k])});
    }
  };
  const auto always = [](const auto&) { return true; };
  const auto never = [](const auto&) { return false; };
  add_all("displacements", input.displacements, is_driven, never);
  add_all("velocities", input.velocities, is_driven, never);
  add_all("loads", input.loads, always, never);
  add_all("tractions", input.tractions, always, always);
  add_all("supports", input.supports, never, never);
  add_all("springs", input.springs, never,
          [](const SpringSection& section) { return section.stiffness.has_value(); });
  return places;
}

/// Returns the sets that contain some particles, ascending.
std::vector<Index> sets_of(std::span<const Index> particles, JoinedParts& parts) {
  std::vector<Index> sets;
  for (const Index i : particles) sets.push_back(parts.find(i));
  std::ranges::sort(sets);
  sets.erase(std::ranges::unique(sets).begin(), sets.end());
  return sets;
}

bool have_common(std::span<const Index> one, std::span<const Index> other) {
  return std::ranges::any_of(one, [&](Index i) { return std::ranges::binary_search(other, i); });
}

}  // namespace

std::optional<std::string> unbreakable_path_note(const CaseFile& input, const Model& model) {
  const Network& network = model.network;
  const bool has_unbreakable = std::ranges::any_of(
      input.materials, [](const auto& material) { return std::isinf(material.fracture_energy); });
  if (network.critical_stretch.empty() || !has_unbreakable) return std::nullopt;
  const Particles& particles = network.particles;
  const auto is_unbreakable = [&](Index i) {
    const Index material = particles.material[i];
    return material != no_index && std::isinf(input.materials[material].fracture_energy);
  };
  JoinedParts by_bonds(particles.size()), by_particles(particles.size());
  for (Index b = 0; b < network.first_contact(); ++b) {
    if (network.can_break(b)) continue;
    const Index i = network.bonds.first[b], j = network.bonds.second[b];
    by_bonds.join(i, j);
    if (is_unbreakable(i) && is_unbreakable(j)) by_particles.join(i, j);
  }
  std::vector<Place> places = places_of(input, model);
  // Loads and supports on breakable particles beside an unbreakable part do not bridge a crack.
  for (Place& place : places) std::erase_if(place.particles, std::not_fn(is_unbreakable));
  for (std::size_t k = 0; k < input.symmetry.size(); ++k) {
    places.push_back({item_key("symmetry", k), particles_of_plane(input, model, k)});
  }
  std::vector<std::pair<std::vector<Index>, std::vector<Index>>> sets;
  for (const Place& place : places) {
    sets.emplace_back(sets_of(place.particles, by_bonds), sets_of(place.particles, by_particles));
  }
  for (std::size_t a = 0; a < places.size(); ++a) {
    for (std::size_t b = a + 1; b < places.size(); ++b) {
      if (!places[a].moves && !places[b].moves) continue;
      if (!have_common(sets[a].first, sets[b].first)) continue;
      if (have_common(sets[a].second, sets[b].second)) continue;
      return fmt::format(
          "unbreakable bonds join \"{}\" and \"{}\" through the breakable particles between them, "
          "since a bond with one unbreakable end does not break: the body cannot separate there, "
          "and load and energy are too high; make the breakable zone wider than two horizons, or "
          "than one horizon beside a plane of symmetry",
          places[a].name, places[b].name);
    }
  }
  return std::nullopt;
}

}  // namespace perilink
