#include "app/commands/check_sizes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>

#include "app/process/progress.hpp"
#include "base/plain_text.hpp"
#include "discretization/lattices/triangulate.hpp"

namespace perilink {
namespace {

void print_breakable(const Network& network, const std::vector<double>& crack_cost) {
  if (network.has_states()) return;  // particles crack, not bonds
  if (network.critical_stretch.empty()) {
    fmt::print("#   breakable bonds    none: the analysis is elastic\n");
    return;
  }
  Index breakable = 0, softening = 0;
  double smallest = INFINITY, largest = 0.0;
  for (Index e = 0; e < network.num_elements(); ++e) {
    if (!network.can_break(e)) continue;
    const double limit = network.critical_stretch[e] * network.law(e).segment(0).limit;
    ++breakable;
    if (network.law(e).segment(1).secant > 0.0) {  // the first event does not break the bond
      ++softening;
      continue;
    }
    smallest = std::min(smallest, limit);
    largest = std::max(largest, limit);
  }
  if (breakable == 0) {
    fmt::print("#   breakable bonds    none\n");
  } else {
    fmt::print("#   breakable bonds    {}", breakable);
    if (softening == breakable) {
      fmt::print(", which soften");
    } else if (softening > 0) {
      fmt::print(", {} of them soften", softening);
    }
    if (softening < breakable) {
      fmt::print(", critical stretch {}{:.5g}", softening > 0 ? "of the others " : "", smallest);
      if (largest > (1.0 + 1e-9) * smallest) fmt::print(" to {:.5g}", largest);
    }
    fmt::print("\n");
  }
  for (std::size_t m = 0; m < crack_cost.size() && breakable > 0; ++m) {
    if (network.report.strengths[m].segments != 1) continue;  // unbreakable or softening
    fmt::print(
        "#   energy correction  a crack dissipates {:.4g} of the energy of its "
        "bonds, material {}\n",
        crack_cost[m], m + 1);
  }
}

/// Prints stretches, fracture energy, strength and process zone of a softening law.
void print_softening(const MaterialStrength& strength) {
  fmt::print(
      "#   softening          at stretches from {:.5g} to {:.5g} in {} "
      "segments\n",
      strength.first_stretch, strength.last_stretch, strength.segments);
  fmt::print("#   fracture energy    {:.5g}\n", strength.fracture_energy);
}

void print_strengths(const std::vector<MaterialStrength>& strengths) {
  for (std::size_t m = 0; m < strengths.size(); ++m) {
    const MaterialStrength& strength = strengths[m];
    if (strength.segments == 0) continue;
    fmt::print("#   tensile strength   {:.5g}, process zone E G/f^2 = {:.4g}, material {}\n",
               strength.tensile_strength, strength.process_zone, m + 1);
    if (strength.compressive_strength > 0.0) {
      fmt::print("#   compression        strength {:.5g}\n", strength.compressive_strength);
    }
    if (strength.segments == 1) {
      fmt::print(
          "#                      follows from the horizon and fracture_energy "
          "(brittle bonds)\n");
    } else {
      print_softening(strength);
    }
  }
}

void print_interfaces(const std::vector<InterfaceBonds>& interfaces) {
  for (std::size_t k = 0; k < interfaces.size(); ++k) {
    const auto& [count, area, strength] = interfaces[k];
    fmt::print("#   interface {}        {} about {:.2g} of area, tensile strength {:.5g}{}\n",
               k + 1, counted(count, "bond crosses", "bonds cross"), area,
               strength.tensile_strength, strength.segments > 1 ? "" : " from the horizon");
    if (strength.segments > 1) print_softening(strength);
  }
}

void print_elements(const Model& model) {
  if (model.elements) {
    fmt::print("#   linear elements    {}\n", model.elements->cells.size());
    return;
  }
  const Network& network = model.network;
  fmt::print("#   bonds              {} and {} of {}\n", network.num_bonds(),
             counted(network.first_bar_element - network.first_slip_spring, "bond-slip spring"),
             counted(model.entry_of_bar.size(), "bar"));
  if (network.cells) {
    fmt::print("#   linear elements    {} tied to the bonds\n", network.cells->cells.size());
  }
  if (network.report.calibration) {
    fmt::print("#   calibration        of {}, about {} at the start of the run\n",
               counted(network.report.calibration->free_bonds, "bond"),
               format_duration(network.report.calibration->seconds));
  }
  for (std::size_t k = 0; k < network.report.cut_by_crack.size(); ++k) {
    fmt::print("#   crack {}            {} cut\n", k + 1,
               counted(network.report.cut_by_crack[k], "bond"));
  }
  print_interfaces(network.report.interfaces);
  print_breakable(network, model.crack_cost);
  print_strengths(network.report.strengths);
}

void print_spacing(const Model& model) {
  const bool mesh = model.lattice.pattern == Pattern::irregular;
  fmt::print("#   {:<18} {:.6g}", mesh ? "mean edge" : "spacing", model.lattice.spacing);
  if (mesh) {
    const std::vector<double> edges = edges_of(model.cells, model.network.particles).lengths;
    const auto [shortest, longest] = std::minmax_element(edges.begin(), edges.end());
    fmt::print(", edges {:.4g} to {:.4g}", *shortest, *longest);
  }
  if (model.horizon > 0.0) {
    fmt::print(", horizon {:.6g} = {:.4g} {}", model.horizon, model.horizon / model.lattice.spacing,
               mesh ? "mean edges" : "spacings");
  }
  fmt::print("\n");
}

/// Formats the first `dim` components of a vector.
std::string vector_text(const Vector3& vector, int dim) {
  std::vector<double> components;
  for (int a = 0; a < dim; ++a) components.push_back(vector[a] + 0.0);  // no -0
  return fmt::format("({})", joined(components));
}

/// Formats the resultant force and moment of a load region.
std::string load_text(const LoadRegion& place, int dim) {
  const auto size = [](const Vector3& v) { return std::hypot(v[0], v[1], v[2]); };
  std::string text = vector_text(place.force, dim);
  if (size(place.moment) > 0.0) {
    text += dim == 2 ? fmt::format(", moment {:.6g}", place.moment[2])
                     : ", moment " + vector_text(place.moment, dim);
  }
  if (place.sizes > (1.0 + 1e-9) * size(place.force)) {
    text += fmt::format(", sum of force magnitudes {:.6g}", place.sizes);
  }
  return text;
}

/// Formats the prescribed displacements of a region, then its prescribed rotations.
std::string motion_text(const PrescribedRegion& place, int dim) {
  std::vector<std::string> parts;
  for (int c = 0; c < static_cast<int>(place.drives.size()); ++c) {
    if (!place.drives[c]) continue;
    const double low = place.low[c], high = place.high[c];
    const std::string name = c < dim    ? std::string(1, "xyz"[c])
                             : dim == 2 ? "rotation"
                                        : fmt::format("rotation about {}", "xyz"[c - dim]);
    parts.push_back(low == high ? fmt::format("{} = {:.6g}", name, low)
                                : fmt::format("{} from {:.6g} to {:.6g}", name, low, high));
  }
  return fmt::format("{}", joined(parts));
}

/// Prints the load of every load region and boundary region at load factor 1. Nothing is printed of
/// cases with stages, which load regions in turn.
void print_places(const Model& model) {
  if (!model.sets.empty()) return;
  const int dim = model.network.particles.dim;
  for (const LoadRegion& place : model.load_regions) {
    fmt::print("#   load               {}: {}\n", place.name, load_text(place, dim));
  }
  for (const PrescribedRegion& place : model.prescribed_regions) {
    fmt::print("#   displacement       {}: {}\n", place.name, motion_text(place, dim));
  }
}

}  // namespace

void print_sizes(const Model& model, bool damage) {
  const Network& network = model.network;
  Index ghosts = 0, bar_nodes = 0;
  for (const ParticleKind kind : network.particles.kind) {
    ghosts += kind == ParticleKind::ghost;
    bar_nodes += kind == ParticleKind::rebar;
  }
  fmt::print("# sizes\n");
  fmt::print("#   particles          {} ({}, {})\n", network.num_particles(),
             counted(ghosts, "ghost"), counted(bar_nodes, "bar node"));
  print_spacing(model);
  print_elements(model);
  if (model.embedded) {
    const std::vector<std::uint8_t>& whole = model.embedded->whole;
    fmt::print("#   finite elements    {} of {} constrain particles with {}\n",
               std::count(whole.begin(), whole.end(), 1), whole.size(),
               counted(model.embedded->free.count, "unknown"));
    if (damage) {
      fmt::print(
          "#                      time and memory refer to the first unknowns "
          "and grow with every released element\n");
    }
  }
  fmt::print("#   unknowns           {}\n", model.unknowns.count);
  for (const Group& group : model.groups) {
    fmt::print("#   group              {}: {}, {} of the surface\n", group.name,
               counted(group.particles.size(), "particle"), counted(group.facets.size(), "facet"));
  }
  print_places(model);
  for (const Gauge& gauge : model.gauges) {
    fmt::print("#   gauge              {}: {}\n", gauge.name, gauge.place);
  }
  for (const std::string& note : model.notes) fmt::print("#   note               {}\n", note);
}

}  // namespace perilink
