#include <fmt/format.h>

#include <cmath>

#include "app/calibration_text.hpp"
#include "app/commands.hpp"
#include "app/configure.hpp"
#include "app/progress.hpp"
#include "assembly/stiffness.hpp"
#include "solver/factor.hpp"

namespace perilink {
namespace {

/// Rough rates of a current processor core, for estimates only.
constexpr double factor_flops_per_second = 15e9;
constexpr double read_bytes_per_second = 20e9;

void print_breakable(const Network& network) {
  Index breakable = 0;
  double smallest = INFINITY, largest = 0.0;
  for (const double limit : network.critical_stretch) {
    if (!std::isfinite(limit)) continue;
    ++breakable;
    smallest = std::min(smallest, limit);
    largest = std::max(largest, limit);
  }
  if (breakable == 0) {
    fmt::print("#   breakable bonds    none\n");
  } else {
    fmt::print("#   breakable bonds    {}, critical stretch {:.5g} to {:.5g}\n", breakable,
               smallest, largest);
  }
}

void print_elements(const Model& model) {
  if (model.elements) {
    fmt::print("#   linear elements    {}\n", model.elements->cells.size());
    return;
  }
  const Network& network = model.network;
  fmt::print("#   bonds              {} and {} ties of bars\n", network.first_tie,
             network.first_segment - network.first_tie);
  if (network.calibration) {
    fmt::print("#   calibration        {}\n", calibration_line(*network.calibration));
  }
  for (std::size_t k = 0; k < network.cut_by_crack.size(); ++k) {
    fmt::print("#   crack {}            {} bonds cut\n", k + 1, network.cut_by_crack[k]);
  }
  print_breakable(network);
}

}  // namespace

int check_case(const std::string& case_path) {
  const CaseFile input = read_case_file(case_path);
  const Model model = build_model(input);
  const Network& network = model.network;
  Index ghosts = 0, bar_nodes = 0;
  for (const ParticleKind kind : network.particles.kind) {
    ghosts += kind == ParticleKind::ghost;
    bar_nodes += kind == ParticleKind::rebar;
  }
  const std::vector<double> intact(static_cast<std::size_t>(network.num_elements()), 1.0);
  const FactorStatistics factor =
      estimate_factor(assemble_stiffness(network, intact, model.unknowns),
                      particle_of_unknown(model.unknowns));

  fmt::print("# {}: the case as resolved\n\n{}\n", case_path, write_case(input));
  fmt::print("# sizes\n");
  fmt::print("#   particles          {} ({} ghosts, {} bar nodes)\n", network.particles.size(),
             ghosts, bar_nodes);
  fmt::print("#   spacing            {:.6g}", model.lattice.spacing);
  if (!model.elements) {
    fmt::print(", horizon {:.6g} = {:.4g} spacings", model.horizon,
               model.horizon / model.lattice.spacing);
  }
  fmt::print("\n");
  print_elements(model);
  fmt::print("#   unknowns           {}\n", model.unknowns.count);
  for (const Group& group : model.groups) {
    fmt::print("#   group              {}: {} particles, {} facets of the surface\n", group.name,
               group.particles.size(), group.facets.size());
  }
  for (const std::string& note : model.notes) fmt::print("#   note               {}\n", note);
  const double bond_bytes = 100.0 * network.num_elements();
  fmt::print("# expected cost\n");
  fmt::print("#   factor             {:.3g} M numbers, {:.3g} MB\n", factor.entries / 1e6,
             factor.bytes / 1e6);
  fmt::print("#   memory             {:.3g} GB\n", (1.3 * factor.bytes + 3.0 * bond_bytes) / 1e9);
  fmt::print("#   factorisation      {}\n",
             format_duration(factor.flops / factor_flops_per_second));
  fmt::print("#   each broken bond   {:.2g} ms\n",
             1e3 * (1.1 * factor.bytes / read_bytes_per_second + 1e-9 * network.num_elements()));
  return exit_done;
}

}  // namespace perilink
