#include "app/model_regions.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "base/error.hpp"

namespace perilink {
namespace {

/// Particles this close to a region's side, in spacings, are inside.
constexpr double region_tolerance = 1e-6;

}  // namespace

const Group& group_named(const Model& model, const std::string& name) {
  return *std::find_if(model.groups.begin(), model.groups.end(),
                       [&](const Group& group) { return group.name == name; });
}

std::vector<Index> particles_of_region(const CaseFile& input, const Model& model,
                                       const std::string& region, const std::string& key) {
  const auto found = std::find_if(input.regions.begin(), input.regions.end(),
                                  [&](const Region& r) { return r.name == region; });
  const Particles& particles = model.network.particles;
  std::vector<Index> inside;
  if (!found->group.empty()) inside = group_named(model, found->group).particles;
  for (Index i = 0; found->group.empty() && i < particles.size(); ++i) {
    if (particles.kind[i] == ParticleKind::ghost) continue;
    if (found->box.contains(particles.position(i), region_tolerance * model.lattice.spacing)) {
      inside.push_back(i);
    }
  }
  const bool any_solid = std::any_of(inside.begin(), inside.end(), [&](Index i) {
    return particles.kind[i] == ParticleKind::solid;
  });
  if (!any_solid) {
    throw InputError(input.where(key),
                     fmt::format("no particle lies in the region \"{}\"", region),
                     fmt::format("particles are {:.6g} apart; make the region larger or move it onto "
                                 "the body",
                                 model.lattice.spacing));
  }
  return inside;
}

}  // namespace perilink
