#include "app/commands/check_conditions.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "base/plain_text.hpp"
#include "discretization/cuts/cracks.hpp"
#include "discretization/neighbor_search.hpp"
#include "io/case/case_words.hpp"
#include "model/model_regions.hpp"

namespace perilink {
namespace {

/// Formats the range of positions of particles per axis.
std::string extent_text(const Particles& particles, std::span<const Index> members) {
  std::vector<std::string> parts;
  for (int axis = 0; axis < particles.dim; ++axis) {
    double lower = infinity, upper = -infinity;
    for (const Index i : members) {
      lower = std::min(lower, particles.position(i)[axis]);
      upper = std::max(upper, particles.position(i)[axis]);
    }
    parts.push_back(fmt::format("{} {:.6g} to {:.6g}", axis_names[axis], lower + 0.0, upper + 0.0));
  }
  return joined(parts);
}

/// Formats how a stage ends.
std::string end_text(const StageSection& stage) {
  const StopSection& stop = stage.stop;
  if (stage.to) return fmt::format("to load factor {:.6g}", *stage.to);
  if (stage.to_load) return fmt::format("to load {:.6g}", *stage.to_load);
  std::vector<std::string> rules;
  if (stop.broken_bonds) rules.push_back(fmt::format("{} broken bonds", *stop.broken_bonds));
  if (stop.load_fraction) rules.push_back(fmt::format("{} of the peak", *stop.load_fraction));
  if (stop.displacement) rules.push_back(fmt::format("displacement {:.6g}", *stop.displacement));
  if (stop.above) rules.push_back(fmt::format("{} above {:.6g}", stop.gauge, *stop.above));
  if (stop.below) rules.push_back(fmt::format("{} below {:.6g}", stop.gauge, *stop.below));
  return rules.empty() ? "to collapse" : "to " + joined(rules);
}

/// Returns the distance from an end of a pre-crack to where the cut bonds between nearest particles
/// end, positive ahead of it; empty for an end outside of the body, or without such bonds.
/// \param before  the point before the end
std::optional<double> rounding_of(const Particles& particles, const CrackCutter& cutter,
                                  const Csr& neighbours, const Vector3& end, const Vector3& before,
                                  double spacing) {
  const double length = std::hypot(end[0] - before[0], end[1] - before[1]);
  const double tx = (end[0] - before[0]) / length, ty = (end[1] - before[1]) / length;
  double ahead = -infinity;
  bool inside = false;  // particles lie ahead of the end
  for (Index i = 0; i < neighbours.rows(); ++i) {
    const auto at = particles.position(i);
    const double along = (at[0] - end[0]) * tx + (at[1] - end[1]) * ty;
    const double beside = (at[1] - end[1]) * tx - (at[0] - end[0]) * ty;
    if (std::abs(beside) > 2.0 * spacing || along < -length - spacing) continue;
    inside = inside || along > spacing;
    for (const Index j : neighbours.row(i)) {
      const auto to = particles.position(j);
      const double middle = 0.5 * (along + (to[0] - end[0]) * tx + (to[1] - end[1]) * ty);
      if (middle > ahead && cutter.cuts({at[0], at[1], 0.0}, {to[0], to[1], 0.0})) ahead = middle;
    }
  }
  if (!inside || ahead == -infinity) return std::nullopt;
  // A straight crack cuts bonds of a square lattice at this mean distance.
  return ahead + 0.5 * spacing / (std::abs(tx) + std::abs(ty));
}

}  // namespace

void print_regions(const CaseFile& input, const Model& model) {
  const Particles& particles = model.network.places();
  std::vector<Index> solid;
  for (Index i = 0; i < particles.size(); ++i) {
    if (particles.kind[i] == ParticleKind::solid) solid.push_back(i);
  }
  fmt::print("#   particles lie in   {}\n", extent_text(particles, solid));
  for (std::size_t k = 0; k < input.regions.size(); ++k) {
    const std::string& name = input.regions[k].name;
    try {
      const auto members = particles_of_region(input, model, name, item_key("regions", k));
      const auto nodes = std::ranges::count_if(
          members, [&](Index i) { return particles.kind[i] == ParticleKind::rebar; });
      const auto solid_members = static_cast<Index>(members.size()) - nodes;
      fmt::print("#   region             {}: {}{}, {}\n", name, counted(solid_members, "particle"),
                 nodes > 0 ? ", " + counted(nodes, "bar node") : "",
                 extent_text(particles, members));
    } catch (const InputError&) {
      fmt::print("#   region             {}: no particles\n", name);
    }
  }
}

void print_symmetry(const CaseFile& input, const Model& model) {
  const Particles& particles = model.network.places();
  for (std::size_t k = 0; k < input.symmetry.size(); ++k) {
    const SymmetrySection& plane = input.symmetry[k];
    if (!plane.at) continue;
    const double room = 0.5 * model.lattice.spacing;
    std::array<bool, 2> beyond{};
    for (Index i = 0; i < particles.size(); ++i) {
      if (particles.kind[i] != ParticleKind::solid) continue;
      const double height = particles.position(i)[plane.axis] - *plane.at;
      if (std::abs(height) > room) beyond[height > 0.0 ? 1 : 0] = true;
    }
    if (!beyond[0] || !beyond[1]) continue;
    fmt::print("#   symmetry           {} = {:.6g} lies inside the body: nothing is mirrored\n",
               "xyz"[plane.axis], *plane.at);
  }
}

void print_bars(const CaseFile& input, const Model& model) {
  const Network& network = model.network;
  double volume = 0.0;
  for (Index i = 0; i < network.particles.size(); ++i) {
    if (network.particles.kind[i] == ParticleKind::solid) volume += network.particles.volumes[i];
  }
  for (std::size_t k = 0; k < input.rebar.size(); ++k) {
    const RebarSection& section = input.rebar[k];
    double length = 0.0;
    for (std::size_t s = 0; s < network.bars.bar.size(); ++s) {
      if (model.entry_of_bar[network.bars.bar[s]] != k) continue;
      length += network.bonds.length(network.first_bar_element + static_cast<Index>(s));
    }
    fmt::print(
        "#   rebar {:<12} {}, area {:.5g}, length {:.6g} in all, {:.2g} % of the volume, "
        "bond {}\n",
        k + 1, counted(std::ranges::count(model.entry_of_bar, k), "bar"), section.area, length,
        100.0 * section.area * length / volume, word_of(section.bond.type));
  }
}

void print_stages(const CaseFile& input, const Model& model) {
  const auto dim = static_cast<std::size_t>(model.network.dim());
  const auto width = static_cast<std::size_t>(model.network.width());
  std::size_t set = 0;
  for (std::size_t k = 0; k < input.stages.size(); ++k) {
    const StageSection& stage = input.stages[k];
    std::string loads;
    if (stage.loads == stage.name && set < model.sets.size()) {
      const LoadCase& own = model.sets[set++];
      std::vector<double> force(dim, 0.0);
      double motion = 0.0;
      for (std::size_t slot = 0; slot < own.loads.forces.size(); ++slot) {
        if (slot % width >= dim) continue;
        force[slot % width] += own.loads.forces[slot];
        motion = std::max(motion, std::abs(own.unknowns.prescribed[slot]));
      }
      if (std::ranges::any_of(force, [](double f) { return f != 0.0; })) {
        loads += fmt::format(", loads ({})", joined(force));
      }
      if (motion > 0.0) loads += fmt::format(", displacements up to {:.6g}", motion);
    } else {
      loads = fmt::format(", loads of {}", stage.loads);
    }
    fmt::print("#   stage {:<12} {}: {}{}\n", k + 1, stage.name, end_text(stage), loads);
  }
}

void print_crack_tips(const CaseFile& input, const Model& model) {
  const Particles& particles = model.network.particles;
  const double spacing = model.lattice.spacing;
  if (particles.dim != 2 || model.lattice.pattern == Pattern::irregular || input.cracks.empty()) {
    return;
  }
  std::vector<Crack> cracks;
  for (const CrackSection& crack : input.cracks) cracks.push_back({crack.points});
  const CrackCutter cutter(cracks, 2, spacing);
  constexpr double next = 1.1, visible = 1e-3;
  const Csr neighbours = find_upper_neighbors(particles.positions, 2, next * spacing);
  for (std::size_t k = 0; k < cracks.size(); ++k) {
    const std::vector<Vector3>& points = cracks[k].points;
    for (const auto& [end, before] : {std::pair{points.front(), points[1]},
                                      std::pair{points.back(), points[points.size() - 2]}}) {
      const auto ahead = rounding_of(particles, cutter, neighbours, end, before, spacing);
      if (!ahead || std::abs(*ahead) < visible * spacing) continue;
      fmt::print(
          "#   crack {:<12} ends at ({:.6g}, {:.6g}) as drawn; bonds are cut up to {:.3g} {}\n",
          k + 1, end[0], end[1], std::abs(*ahead), *ahead > 0.0 ? "ahead of it" : "before it");
    }
  }
}

}  // namespace perilink
