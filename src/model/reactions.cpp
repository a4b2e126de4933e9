#include "model/reactions.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "assembly/internal_force.hpp"
#include "discretization/facet_geometry.hpp"
#include "io/case/case_words.hpp"
#include "io/text/csv.hpp"
#include "model/model_regions.hpp"

namespace perilink {
namespace {

/// Returns the particles on springs, ascending. A stiffness per area acts on the corners of its
/// facets, which may lie outside the region; a total is shared by all particles of the region.
std::vector<Index> sprung_particles(const CaseFile& input, const Model& model, std::size_t k) {
  const SpringSection& section = input.springs[k];
  const std::string key = item_key("springs", k, "region");
  if (!section.stiffness) return particles_of_region(input, model, section.region, key);
  std::vector<Index> corners;
  for (const Index facet : facets_of_region(input, model, section.region, key)) {
    const std::span<const Index> row = model.facets.corners.row(facet);
    corners.insert(corners.end(), row.begin(), row.end());
  }
  std::sort(corners.begin(), corners.end());
  return corners;
}

/// Returns the moment of a force with a lever arm.
Vector3 moment_of(const Vector3& arm, const Vector3& force) {
  return {arm[1] * force[2] - arm[2] * force[1], arm[2] * force[0] - arm[0] * force[2],
          arm[0] * force[1] - arm[1] * force[0]};
}

Vector3 position_of(const Particles& particles, Index i) {
  Vector3 x{};
  std::copy_n(particles.position(i).begin(), particles.dim, x.begin());
  return x;
}

std::string row_of(const std::string& name, const Reaction& reaction, int dim) {
  CsvRow row;
  row.text(name);
  for (int a = 0; a < dim; ++a) row.number(reaction.middle[a]);
  for (int a = 0; a < dim; ++a) row.number(reaction.force[a]);
  for (int a = dim == 2 ? 2 : 0; a < 3; ++a) row.number(reaction.moment[a]);
  return row.end();
}

}  // namespace

Reaction about(const Vector3& point, Reaction reaction) {
  const Vector3 more = moment_of(minus(reaction.middle, point), reaction.force);
  for (int a = 0; a < 3; ++a) reaction.moment[a] += more[a];
  reaction.middle = point;
  return reaction;
}

std::vector<double> present_loads(const Model& model, const ModelState& state) {
  std::vector<double> loads = model.loads.forces;
  for (double& load : loads) load *= state.set_factors.empty() ? state.load_factor : 0.0;
  for (std::size_t s = 0; s < state.set_factors.size(); ++s) {
    const std::vector<double>& forces = model.sets[s].loads.forces;
    for (std::size_t k = 0; k < loads.size(); ++k) loads[k] += state.set_factors[s] * forces[k];
  }
  return loads;
}

std::vector<std::uint8_t> held_slots(const Model& model) {
  std::vector<std::uint8_t> held(model.unknowns.number.size(), 0);
  for (std::size_t slot = 0; slot < held.size(); ++slot) {
    if (model.unknowns.number[slot] == no_index) held[slot] = 1;
    for (const LoadCase& set : model.sets) {
      if (set.unknowns.number[slot] == no_index) held[slot] = 1;
    }
  }
  const std::vector<double>& springs = model.network.support_stiffness;
  for (std::size_t slot = 0; slot < springs.size(); ++slot) {
    if (springs[slot] > 0.0) held[slot] = 1;
  }
  return held;
}

void pass_to_held(const Model& model, std::span<const std::uint8_t> whole,
                  std::span<const double> loads, std::span<double> forces) {
  if (!model.embedded) return;
  const EmbeddedBody& body = *model.embedded;
  pass_to_held(body.hosts, body.free, whole.empty() ? body.whole : whole, loads, forces);
}

namespace {

/// Returns the displacements under the present loads.
std::vector<double> present_motion(const ModelState& state) {
  std::vector<double> motion(state.motion.begin(), state.motion.end());
  for (double& u : motion) u *= state.scale;
  return motion;
}

/// Returns the forces of all elements, with those on embedded points.
std::vector<double> internal_forces(const Model& model, const ModelState& state) {
  if (!state.internal.empty()) return {state.internal.begin(), state.internal.end()};
  const std::vector<double> motion = present_motion(state);
  return model.elements ? internal_force(*model.elements, motion).forces
                        : internal_force(model.network, state.secants, motion).forces;
}

/// Returns the reactions, see holding_forces().
/// \param forces  internal_forces()
std::vector<double> reactions_from(const Model& model, const ModelState& state,
                                   std::vector<double> forces) {
  const Network& network = model.network;
  const std::vector<double> motion = present_motion(state);
  load_particles(network, forces);
  const std::vector<double> loads = present_loads(model, state);
  pass_to_held(model, state.whole, loads, forces);
  const std::vector<std::uint8_t> held = held_slots(model);
  const std::vector<double>& springs = network.support_stiffness;
  for (std::size_t slot = 0; slot < forces.size(); ++slot) {
    const double spring = springs.empty() ? 0.0 : springs[slot] * motion[slot];
    forces[slot] = held[slot] != 0 ? forces[slot] - spring - loads[slot] : 0.0;
  }
  return forces;
}

/// Returns the sum over bonds and bars of stiffness times motion, times the digits lost [force].
double round_off_of(const Network& network, const ModelState& state) {
  const auto width = static_cast<std::size_t>(network.width());
  double sum = 0.0;
  if (state.motion.empty()) return sum;
  for (Index e = 0; e < static_cast<Index>(network.stiffness.size()); ++e) {
    const std::size_t i = network.bonds.first[e] * width, j = network.bonds.second[e] * width;
    for (int a = 0; a < network.dim(); ++a) {
      sum += state.secants.axial(e) * network.stiffness[e] *
             (std::abs(state.motion[i + a]) + std::abs(state.motion[j + a]));
    }
  }
  return std::numeric_limits<double>::epsilon() * std::abs(state.scale) * sum;
}

/// Returns the sum of the magnitudes of forces on embedded points [force].
double size_on_bars(const Network& network, std::span<const double> forces) {
  const auto width = static_cast<std::size_t>(network.width());
  double size = 0.0;
  for (std::size_t slot = network.first_embedded_point() * width; slot < forces.size(); ++slot) {
    if (static_cast<int>(slot % width) < network.dim()) size += std::abs(forces[slot]);
  }
  return size;
}

}  // namespace

std::vector<double> holding_forces(const Model& model, const ModelState& state) {
  return reactions_from(model, state, internal_forces(model, state));
}

Reaction reaction_on(const Model& model, std::span<const Index> particles,
                     std::span<const double> forces) {
  const int dim = model.network.dim(), width = model.network.width();
  Reaction sum;
  if (particles.empty()) return sum;
  for (const Index i : particles) {
    const Vector3 x = position_of(model.network.particles, i);
    for (int a = 0; a < dim; ++a) sum.middle[a] += x[a] / static_cast<double>(particles.size());
  }
  for (const Index i : particles) {
    Vector3 arm = position_of(model.network.particles, i), force{};
    const double* own = forces.data() + static_cast<std::size_t>(i) * width;
    std::copy_n(own, dim, force.begin());
    sum.force_size += norm(force);
    for (int a = 0; a < 3; ++a) arm[a] -= sum.middle[a];
    const Vector3 moment = moment_of(arm, force);
    for (int a = 0; a < 3; ++a) {
      sum.force[a] += force[a];
      sum.moment[a] += moment[a];
    }
    for (int a = dim; a < width; ++a) {
      sum.moment[dim == 2 ? 2 : a - dim] += own[a];
      sum.moment_size += std::abs(own[a]);
    }
  }
  return sum;
}

std::vector<SupportRegion> support_regions(const CaseFile& input, const Model& model) {
  const std::vector<std::uint8_t> held = held_slots(model);
  const auto width = static_cast<std::size_t>(model.network.width());
  std::vector<std::uint8_t> taken(held.size() / width, 0);
  std::vector<SupportRegion> places;
  const auto add = [&](const std::string& name, const std::vector<Index>& particles) {
    SupportRegion& place = place_named(places, name);
    for (const Index i : particles) {
      const auto own = held.begin() + static_cast<std::ptrdiff_t>(i * width);
      const bool holds = std::any_of(own, own + static_cast<std::ptrdiff_t>(width),
                                     [](std::uint8_t h) { return h != 0; });
      if (taken[i] != 0 || !holds) continue;
      taken[i] = 1;
      place.particles.push_back(i);
    }
  };
  const auto add_all = [&](const std::string& table, const auto& sections) {
    for (std::size_t k = 0; k < sections.size(); ++k) {
      add(fmt::format("{}: {}", table, sections[k].region),
          particles_of_region(input, model, sections[k].region, item_key(table, k, "region")));
    }
  };
  add_all("supports", input.supports);
  add_all("displacements", input.displacements);
  add_all("velocities", input.velocities);
  for (std::size_t k = 0; k < input.symmetry.size(); ++k) {
    const SymmetrySection& plane = input.symmetry[k];
    add(plane.at ? fmt::format("symmetry: {} = {:.6g}", axis_names[plane.axis], *plane.at)
                 : "symmetry: " + plane.region,
        particles_of_plane(input, model, k));
  }
  for (std::size_t k = 0; k < input.springs.size(); ++k) {
    add("springs: " + input.springs[k].region, sprung_particles(input, model, k));
  }
  std::erase_if(places, [](const SupportRegion& place) { return place.particles.empty(); });
  return places;
}

ReactionTable reaction_table(const std::vector<SupportRegion>& places, const Model& model,
                             const ModelState& state, std::vector<double> forces) {
  const int dim = model.network.dim();
  std::string text = dim == 2 ? "place,x,y,force_x,force_y,moment\n"
                              : "place,x,y,z,force_x,force_y,force_z,moment_x,moment_y,moment_z\n";
  double on_bars = 0.0;
  if (forces.empty()) {
    forces = internal_forces(model, state);
    on_bars = size_on_bars(model.network, forces);
    forces = reactions_from(model, state, std::move(forces));
  }
  std::vector<Index> everything(static_cast<std::size_t>(model.network.particles.size()));
  std::iota(everything.begin(), everything.end(), 0);
  const Reaction all = reaction_on(model, everything, present_loads(model, state));
  Reaction sum = about({}, all);
  std::string loads = row_of("loads", sum, dim);
  for (const SupportRegion& place : places) {
    const Reaction reaction = reaction_on(model, place.particles, forces);
    text += row_of(place.name, reaction, dim);
    const Reaction moved = about({}, reaction);
    for (int a = 0; a < 3; ++a) {
      sum.force[a] += moved.force[a];
      sum.moment[a] += moved.moment[a];
    }
    sum.force_size += moved.force_size;
    sum.moment_size += moved.moment_size;
  }
  text += loads + row_of("sum", sum, dim);
  sum = about(all.middle, sum);
  sum.force_size += on_bars;
  return {std::move(text), sum, round_off_of(model.network, state)};
}

std::vector<VtuArray> condition_fields(const Model& model) {
  const std::vector<std::uint8_t> held = held_slots(model);
  const auto dim = static_cast<std::size_t>(model.network.dim());
  const auto width = static_cast<std::size_t>(model.network.width());
  const std::size_t count = held.size() / width;
  std::vector<VtuArray> fields = {{"held", 1, std::vector<double>(count)},
                                  {"applied_force", 3, std::vector<double>(3 * count)},
                                  {"prescribed_displacement", 3, std::vector<double>(3 * count)}};
  const auto add = [&](const Loads& loads, const Unknowns& unknowns) {
    for (std::size_t i = 0; i < count; ++i) {
      for (std::size_t a = 0; a < dim; ++a) {
        const std::size_t slot = i * width + a;
        fields[1].values[3 * i + a] += loads.forces[slot];
        if (unknowns.number[slot] == no_index) {
          fields[2].values[3 * i + a] += unknowns.prescribed[slot];
        }
      }
    }
  };
  if (model.sets.empty()) add(model.loads, model.unknowns);
  for (const LoadCase& set : model.sets) add(set.loads, set.unknowns);
  for (std::size_t slot = 0; slot < held.size(); ++slot) {
    if (held[slot] != 0 && slot % width < dim) {
      fields[0].values[slot / width] += static_cast<double>(1U << (slot % width));
    }
  }
  std::erase_if(fields, [](const VtuArray& field) {
    return std::ranges::all_of(field.values, [](double value) { return value == 0.0; });
  });
  return fields;
}

void ReactionBalance::add(Index row, const Reaction& sum, double length, double tolerance,
                          double round_off) {
  size_ = std::max(size_, sum.force_size + sum.moment_size / length);
  if (row_ > 0 || size_ == 0.0) return;
  const double force = std::max(norm(sum.force), norm(sum.moment) / length);
  const double imbalance = force / size_;
  if (imbalance <= tolerance || force <= round_off) return;
  row_ = row;
  imbalance_ = imbalance;
}

std::optional<std::string> ReactionBalance::warning() const {
  if (row_ == 0) return std::nullopt;
  return fmt::format(
      "reactions and loads of row {} are out of balance by {:.2g} of their "
      "magnitude: forces or moments in the files of reactions from this row "
      "on have this error; the curve and energies come from displacements "
      "and are not affected",
      row_, imbalance_);
}

}  // namespace perilink
