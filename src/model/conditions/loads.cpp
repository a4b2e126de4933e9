#include "model/conditions/loads.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "assembly/distributed_loads.hpp"
#include "base/error.hpp"
#include "base/plain_text.hpp"
#include "model/conditions/formula_field.hpp"
#include "model/model_regions.hpp"
#include "network/loaded_network.hpp"

namespace perilink {
namespace {

/// Distance in spacings within which a point load counts as placed on its particle.
constexpr double moved = 1e-6;

std::span<const Expression> components_of(const ExpressionVector& vector, int dim) {
  return {vector.data(), static_cast<std::size_t>(dim)};
}

/// Returns the solid particles of a region; of a region with bars only, their nodes.
std::vector<Index> solid_particles_of(const CaseFile& input, const Model& model,
                                      const std::string& region, const std::string& key) {
  std::vector<Index> members = particles_of_region(input, model, region, key);
  const auto is_bar = [&](Index i) {
    return model.network.places().kind[i] != ParticleKind::solid;
  };
  if (!std::all_of(members.begin(), members.end(), is_bar)) std::erase_if(members, is_bar);
  return members;
}

/// Distributes a total force over the solid particles of a region, or integrates a uniform body
/// force.
void add_uniform_load(const LoadSection& section, const Model& model, std::span<const Index> region,
                      Loads& loads, LoadRegion& place) {
  const Particles& particles = model.network.places();
  const std::size_t width = loads.forces.size() / static_cast<std::size_t>(particles.size());
  const Simplices& cells = model.elements ? model.elements->cells : model.cells;
  const std::vector<double> shares =
      section.force ? force_shares(particles, cells, model.facets, region) : particles.volumes;
  double whole = 0.0;
  for (const Index i : region) whole += shares[i];
  Vector3 sum{};
  for (int a = 0; a < particles.dim; ++a) {
    sum[a] = section.force ? (*section.force)[a] : (*section.body_force)[a].number * whole;
    place.force[a] += sum[a];
    for (const Index i : region) loads.forces[i * width + a] += sum[a] * shares[i] / whole;
  }
  place.sizes += std::hypot(sum[0], sum[1], sum[2]);
}

/// Adds the forces of an entry to all loads and to its load region. \return the sum of force
/// magnitudes
double add_entry(const Particles& particles, const Loads& entry, Loads& loads, LoadRegion& place) {
  const std::size_t width = entry.forces.size() / static_cast<std::size_t>(particles.size());
  double sizes = 0.0;
  for (Index i = 0; i < particles.size(); ++i) {
    Vector3 force{};
    for (int a = 0; a < particles.dim; ++a) {
      force[a] = entry.forces[i * width + a];
      loads.forces[i * width + a] += force[a];
      place.force[a] += force[a];
    }
    sizes += std::hypot(force[0], force[1], force[2]);
  }
  return sizes;
}

void add_body_force(const CaseFile& input, const Model& model, std::size_t k,
                    std::span<const Index> region, Loads& loads) {
  const Particles& particles = model.network.places();
  const PositionField field(input, item_key("loads", k, "body_force"),
                            components_of(*input.loads[k].body_force, particles.dim));
  const auto load = [&](std::span<const double> x) { return field.at(x); };
  if (model.cells.size() == 0 || model.network.shell) {
    add_lumped_body_load(particles, region, load, loads);
    return;
  }
  std::vector<std::uint8_t> is_member(static_cast<std::size_t>(particles.size()), 0);
  for (const Index i : region) is_member[i] = 1;
  const double thickness = particles.dim == 2 ? input.body.thickness : 1.0;
  add_cell_body_load(particles, model.cells, thickness, is_member, load, loads);
}

/// Adds a traction. \return the sum of force magnitudes over facets, because a particle at an edge
/// of the body carries forces of two faces
double add_traction(const CaseFile& input, const Model& model, std::size_t k, Loads& loads) {
  const TractionSection& section = input.tractions[k];
  const Particles& particles = model.network.places();
  const std::vector<Index> facets =
      facets_of_region(input, model, section.region, item_key("tractions", k, "region"));
  if (section.traction) {
    const PositionField field(input, item_key("tractions", k, "traction"),
                              components_of(*section.traction, particles.dim));
    return add_surface_load(
        particles, model.facets, facets,
        [&](std::span<const double> x, const Vector3&) { return field.at(x); }, loads);
  }
  const PositionField field(input, item_key("tractions", k, "pressure"), {&*section.pressure, 1});
  return add_surface_load(
      particles, model.facets, facets,
      [&](std::span<const double> x, const Vector3& normal) {
        const double pressure = field.at(x)[0];
        return Vector3{-pressure * normal[0], -pressure * normal[1], -pressure * normal[2]};
      },
      loads);
}

bool resists_rotation(const Network& network, Index particle) {
  const std::vector<std::uint8_t> rotating = rotating_particles(network);
  return !rotating.empty() && rotating[particle];
}

/// Adds the force and moment of a point load.
void add_point_load(const CaseFile& input, const Model& model, std::size_t k, AppliedLoads& all) {
  const PointLoadSection& section = input.point_loads[k];
  const Particles& particles = model.network.places();
  const int dim = particles.dim;
  const std::size_t width = all.loads.forces.size() / static_cast<std::size_t>(particles.size());
  const std::span<const double> at(section.at.data(), static_cast<std::size_t>(dim));
  const NearestParticle nearest = nearest_particle(particles, at);
  const double spacing = spacing_around(model, nearest.particle);
  if (nearest.distance > spacing) {
    throw InputError(
        input.where(item_key("point_loads", k, "at")),
        fmt::format("is ({}), {:.6g} from the nearest particle", joined(at), nearest.distance),
        fmt::format("the spacing there is {:.6g}; place the load within this distance of a "
                    "particle",
                    spacing));
  }
  if (nearest.distance > moved * spacing) {
    all.notes.push_back(fmt::format("the point load at ({}) acts on the particle at ({})",
                                    joined(at), joined(particles.position(nearest.particle))));
  }
  if (section.moment != Vector3{} && !resists_rotation(model.network, nearest.particle)) {
    if (!model.network.hinged.empty()) {
      throw InputError(input.where(item_key("point_loads", k, "moment")),
                       "acts on a particle without rotation: it lies in the interface of two "
                       "layers",
                       "move the moment to a particle beside the interface");
    }
    throw InputError(input.where(item_key("point_loads", k, "moment")),
                     "acts on a particle whose bonds have no rotational stiffness",
                     "give a Poisson's ratio below the bond-based one, so that bonds have "
                     "bending stiffness, or apply a couple of forces");
  }
  double* force = all.loads.forces.data() + nearest.particle * width;
  for (int a = 0; a < dim; ++a) force[a] += section.force[a];
  for (std::size_t a = dim; a < width; ++a) force[a] += section.moment[dim == 2 ? 2 : a - dim];
  LoadRegion& place = place_named(
      all.places, fmt::format("particle at ({})", joined(particles.position(nearest.particle))));
  for (int a = 0; a < 3; ++a) {
    place.force[a] += section.force[a];
    place.moment[a] += section.moment[a];
  }
  place.sizes += std::hypot(section.force[0], section.force[1], section.force[2]);
}

}  // namespace

AppliedLoads collect_loads(const CaseFile& input, const Model& model, int width,
                           const std::string& stage) {
  const auto belongs = [&](const auto& section) { return stage.empty() || section.stage == stage; };
  const Particles& particles = model.network.places();
  AppliedLoads all;
  all.loads.forces.assign(static_cast<std::size_t>(particles.size()) * width, 0.0);
  for (std::size_t k = 0; k < input.loads.size(); ++k) {
    const LoadSection& section = input.loads[k];
    if (!belongs(section)) continue;
    const std::vector<Index> region =
        solid_particles_of(input, model, section.region, item_key("loads", k, "region"));
    LoadRegion& place = place_named(all.places, section.region);
    if (section.force || section.body_force->is_constant()) {
      add_uniform_load(section, model, region, all.loads, place);
      continue;
    }
    Loads entry{std::vector<double>(all.loads.forces.size(), 0.0)};
    add_body_force(input, model, k, region, entry);
    place.sizes += add_entry(particles, entry, all.loads, place);
  }
  for (std::size_t k = 0; k < input.tractions.size(); ++k) {
    if (!belongs(input.tractions[k])) continue;
    Loads entry{std::vector<double>(all.loads.forces.size(), 0.0)};
    LoadRegion& place = place_named(all.places, input.tractions[k].region);
    place.sizes += add_traction(input, model, k, entry);
    add_entry(particles, entry, all.loads, place);
  }
  for (std::size_t k = 0; k < input.point_loads.size(); ++k) {
    if (belongs(input.point_loads[k])) add_point_load(input, model, k, all);
  }
  return all;
}

}  // namespace perilink
