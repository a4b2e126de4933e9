#include <fmt/format.h>

#include <cmath>
#include <cstdio>
#include <string>

#include "clouds.hpp"
#include "problems/program.hpp"
#include "problems/result.hpp"

namespace perilink::verification {
namespace {

std::string row(const UnstructuredParticles& particle_set, bool torn) {
  const ParticleNetwork built = build(particle_set);
  const ParticleFitReport& fit = built.report;
  const Stretching found = stretch(particle_set, built);
  const bool plane = particle_set.problem != Problem::three_dimensional;
  std::string text =
      fmt::format("{},{:.4g},{},{},{:.3f},{:.3f},{},{:.4f},{:.4f}",
                  plane ? (particle_set.square ? "square" : "hexagonal") : "cubic",
                  particle_set.spacing / particle_set.width, particle_set.scatter,
                  built.network.particles.size(), fit.mean_residual, fit.largest_residual,
                  fit.many + fit.indefinite + fit.singular, found.modulus, found.displacement);
  if (!torn) return text + ",,,,\n";
  const ExplicitResult result = tear(particle_set, built);
  const double section = particle_set.width * (plane ? particle_set.thickness : particle_set.width);
  return text + fmt::format(",{:.3f},{:.2f},{},{:.1e}\n",
                            std::abs(result.peak_load) / (strength * section),
                            result.last.energy.fractured / (fracture_energy * section),
                            result.last.cracked_particles, result.largest_surplus);
}

}  // namespace

/// How stiff and how strong are bars whose particles stand at random? Writes result.csv.
bool run_program(const std::vector<std::string>& /*arguments*/) {
  std::string table =
      "body,spacing_over_width,scatter,particles,mean_residual,largest_residual,ill_posed,"
      "modulus,displacement_error,peak_over_strength,fractured_over_gf,cracked,energy_surplus\n";
  const auto add = [&](const UnstructuredParticles& particle_set, bool torn) {
    table += row(particle_set, torn);
    fmt::print(stderr, ".");
  };
  for (const double columns : {15.0, 30.0, 60.0}) {
    add({0.15, 0.3, 0.15, Problem::plane_stress, 0.15 / columns, 0.0, true}, columns == 15.0);
  }
  for (const double scatter : {0.0, 0.1, 0.2, 0.3}) {
    for (const double columns : {15.0, 30.0, 60.0}) {
      add({0.15, 0.3, 0.15, Problem::plane_stress, 0.15 / columns, scatter}, columns == 15.0);
    }
  }
  for (const double scatter : {0.0, 0.1, 0.2}) {
    for (const double columns : {6.0, 12.0}) {
      add({0.06, 0.12, 1.0, Problem::three_dimensional, 0.06 / columns, scatter}, columns == 6.0);
    }
  }
  fmt::print("\n{}", table);
  write_result(PERILINK_STUDY_DIR, table);
  return true;
}

}  // namespace perilink::verification
