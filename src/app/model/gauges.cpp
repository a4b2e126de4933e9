#include "app/model/gauges.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/model/model_regions.hpp"
#include "app/results/history_file.hpp"
#include "base/error.hpp"
#include "discretization/bonds.hpp"

namespace perilink {
namespace {

Index particle_at(const CaseFile& input, const Model& model, const std::string& key,
                  const Vector3& point) {
  const Particles& particles = model.network.places();
  const std::span<const double> at(point.data(), static_cast<std::size_t>(particles.dim));
  const NearestParticle nearest = nearest_particle(particles, at);
  if (nearest.distance <= model.lattice.spacing) return nearest.particle;
  throw InputError(
      input.where(key),
      fmt::format("the point ({}) is {:.6g} from the nearest particle", fmt::join(at, ", "),
                  nearest.distance),
      fmt::format("particles are {:.6g} apart; a point of a gauge must lie within that of one",
                  model.lattice.spacing));
}

/// Displacement of the second point relative to the first.
void fill_difference(const CaseFile& input, const Model& model, const std::string& key,
                     const GaugeSection& section, Gauge& gauge) {
  const Index from = particle_at(input, model, key, section.between[0]);
  const Index to = particle_at(input, model, key, section.between[1]);
  if (from == to) {
    throw InputError(input.where(key), "gives two points with the same nearest particle",
                     "move the points apart or refine the spacing");
  }
  gauge.terms = {{from, -1.0}, {to, 1.0}};
  if (section.axis) return;
  Vector3 a = section.between[0], b = section.between[1];
  if (model.network.shell) {  // the points are on the flat sheet, the particles in space
    for (int axis = 0; axis < 3; ++axis) {
      a[axis] = model.network.particles.position(from)[axis];
      b[axis] = model.network.particles.position(to)[axis];
    }
  }
  const double length = std::hypot(b[0] - a[0], b[1] - a[1], b[2] - a[2]);
  for (int axis = 0; axis < 3; ++axis) gauge.direction[axis] = (b[axis] - a[axis]) / length;
}

void fill_mean(const CaseFile& input, const Model& model, const std::string& key,
               const GaugeSection& section, Gauge& gauge) {
  const Particles& particles = model.network.places();
  double whole = 0.0;
  const std::vector<Index> members = particles_of_region(input, model, section.region, key);
  const auto is_bar = [&](Index i) { return particles.kind[i] != ParticleKind::solid; };
  const bool bars_alone = std::all_of(members.begin(), members.end(), is_bar);
  if (bars_alone && section.stress) {
    throw InputError(input.where(key),
                     fmt::format("is \"{}\", which holds only bars", section.region),
                     "name a region with particles of the solid");
  }
  for (const Index i : members) {
    if (is_bar(i) && !bars_alone) continue;
    gauge.terms.push_back({i, particles.volumes[i]});
    whole += particles.volumes[i];
  }
  for (Gauge::Term& term : gauge.terms) term.weight /= whole;
}

/// Number of a component among the six of a Stress.
std::size_t number_of(const std::array<int, 2>& axes) {
  if (axes[0] == axes[1]) return axes[0];
  return axes[0] == 1 ? 4 : axes[1] == 1 ? 3 : 5;
}

}  // namespace

std::vector<Gauge> build_gauges(const CaseFile& input, const Model& model) {
  std::vector<Gauge> gauges;
  const std::vector<std::string> taken = history_columns(input);
  for (std::size_t k = 0; k < input.gauges.size(); ++k) {
    const GaugeSection& section = input.gauges[k];
    if (std::find(taken.begin(), taken.end(), section.name) != taken.end()) {
      throw InputError(input.where(item_key("gauges", k, "name")),
                       fmt::format("is \"{}\", a column that every history has", section.name),
                       "choose another name");
    }
    Gauge gauge;
    gauge.name = section.name;
    gauge.stress = section.stress;
    if (section.axis) gauge.direction[*section.axis] = 1.0;
    if (section.at) {
      gauge.terms = {{particle_at(input, model, item_key("gauges", k, "at"), *section.at), 1.0}};
    } else if (!section.region.empty()) {
      fill_mean(input, model, item_key("gauges", k, "region"), section, gauge);
    } else {
      fill_difference(input, model, item_key("gauges", k, "between"), section, gauge);
    }
    gauges.push_back(std::move(gauge));
  }
  return gauges;
}

StressInput stress_input(const Model& model, const Csr& families, Secants secants) {
  return {model.network, families, model.problem, model.hooke, model.elements.has_value(), secants};
}

std::vector<double> gauge_values(const Model& model, const ModelState& state, Csr& families) {
  const std::size_t width = model.network.width();
  std::vector<double> values;
  for (const Gauge& gauge : model.gauges) {
    if (!gauge.stress) {
      values.push_back(state.scale * gauge_value(gauge, model.network.dim(), [&](Index i, int a) {
                         return state.motion[i * width + a];
                       }));
      continue;
    }
    const std::size_t component = number_of(*gauge.stress);
    double value = 0.0;
    if (!state.stresses.empty()) {
      for (const Gauge::Term& term : gauge.terms) {
        value += term.weight * state.stresses[term.particle * Stress{}.size() + component];
      }
      values.push_back(value);
      continue;
    }
    if (families.rows() == 0) {
      families = bonds_of_particles(model.network.bonds, model.network.particles.size());
    }
    const StressInput input = stress_input(model, families, state.secants);
    for (const Gauge::Term& term : gauge.terms) {
      value += term.weight * stress_at(input, state.motion, term.particle)[component];
    }
    values.push_back(state.scale * value);
  }
  return values;
}

}  // namespace perilink
