#include "model/surface_of_case.hpp"

#include <algorithm>
#include <cmath>

#include "io/case/sections/case_kinds.hpp"

namespace perilink {
namespace {

/// Marks the corners of the surface and computes their normals, weighted with facet areas.
void fill_normals(const Model& model, SurfaceConditions& surface) {
  const Facets& facets = model.facets;
  for (Index f = 0; f < facets.size(); ++f) {
    const auto corners = facets.corners.row(f);
    if (facets.on_surface(f)) {
      surface.particles.insert(surface.particles.end(), corners.begin(), corners.end());
    }
  }
  std::sort(surface.particles.begin(), surface.particles.end());
  surface.particles.erase(std::unique(surface.particles.begin(), surface.particles.end()),
                          surface.particles.end());
  const auto dim = static_cast<std::size_t>(surface.dim);
  surface.normals.assign(surface.particles.size() * dim, 0.0);
  for (Index f = 0; f < facets.size(); ++f) {
    if (!facets.on_surface(f)) continue;
    for (const Index corner : facets.corners.row(f)) {
      const auto at = std::lower_bound(surface.particles.begin(), surface.particles.end(), corner) -
                      surface.particles.begin();
      for (std::size_t a = 0; a < dim; ++a) {
        surface.normals[static_cast<std::size_t>(at) * dim + a] += facets.area_vector(f)[a];
      }
    }
  }
  for (std::size_t k = 0; k < surface.normals.size(); k += dim) {
    double square = 0.0;
    for (std::size_t a = 0; a < dim; ++a) square += std::pow(surface.normals[k + a], 2);
    // Facets that face each other cancel up to round-off in areas; such a particle has no normal.
    for (std::size_t a = 0; a < dim && square > 0.0; ++a) {
      surface.normals[k + a] /= std::sqrt(square);
    }
  }
}

}  // namespace

SurfaceConditions surface_of_case(const CaseFile& input, const Model& model) {
  const Network& network = model.network;
  SurfaceConditions surface;
  const bool precise = network.report.calibration || model.elements;
  if (!is_quasistatic(input.analysis.type) || !precise || network.has_sections()) return surface;
  surface.dim = network.dim();
  fill_normals(model, surface);
  if (surface.empty()) return surface;

  const int width = network.width(), dim = network.dim();
  surface.unloaded.assign(network.particles.size(), static_cast<std::uint8_t>((1 << dim) - 1));
  const auto load = [&](Index particle, int component) {
    surface.unloaded[particle] &=
        static_cast<std::uint8_t>(component < dim ? ~(1 << component) : 0);
  };
  const auto load_where = [&](const auto& acts) {
    for (Index i = 0; i < network.particles.size(); ++i) {
      for (int a = 0; a < width; ++a) {
        if (acts(static_cast<std::size_t>(i) * width + a)) load(i, a);
      }
    }
  };
  const auto load_by = [&](const Loads& loads, const Unknowns& unknowns) {
    load_where([&](std::size_t slot) {
      const bool forced = !loads.forces.empty() && loads.forces[slot] != 0.0;
      return forced || unknowns.number[slot] == no_index;
    });
  };
  load_by(model.loads, model.unknowns);
  for (const LoadCase& set : model.sets) load_by(set.loads, set.unknowns);
  const std::vector<double>& springs = network.support_stiffness;
  if (!springs.empty()) load_where([&](std::size_t slot) { return springs[slot] != 0.0; });
  for (Index e = network.first_slip_spring; e < network.num_elements(); ++e) {
    for_each_end(network, e, [&](Index i, bool, double) { load(i, dim); });
  }
  return surface;
}

}  // namespace perilink
