#include "model/gauges.hpp"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "base/dense/decompositions.hpp"
#include "base/error.hpp"
#include "base/plain_text.hpp"
#include "discretization/bonds.hpp"
#include "discretization/facet_geometry.hpp"
#include "model/crack_shares.hpp"
#include "model/model_regions.hpp"
#include "model/reactions.hpp"
#include "network/builder/shell_bonds.hpp"
#include "results/history_file.hpp"

namespace perilink {
namespace {

/// Returns the weighted mean position of some particles.
Vector3 place_of(const Particles& particles, std::span<const Gauge::Term> terms) {
  Vector3 place{};
  for (const Gauge::Term& term : terms) {
    for (int a = 0; a < particles.dim; ++a) {
      place[a] += term.weight * particles.position(term.particle)[a];
    }
  }
  return place;
}

std::string point_text(const Vector3& point, int dim) {
  std::vector<double> components;
  for (int a = 0; a < dim; ++a) components.push_back(point[a] + 0.0);  // no -0
  return fmt::format("({})", joined(components));
}

/// Particles around a point are at most this far from it [spacings]: distant ones around it measure
/// elsewhere.
constexpr double gauge_reach = 2.0;

/// Returns particles with an intact bond to a particle, nearest to `point` first; without known
/// bonds those around it. Broken bonds do not count, since displacements jump across cracks.
/// Stresses jump between materials.
std::vector<Index> neighbors_of(const Model& model, Index particle, const Vector3& point,
                                bool same_material) {
  const Network& network = model.network;
  const Particles& particles = network.places();
  const auto away = [&](Index i, const auto& from) {
    double square = 0.0;
    for (int a = 0; a < particles.dim; ++a) {
      square += std::pow(particles.position(i)[a] - from[a], 2);
    }
    return square;
  };
  std::vector<Index> neighbors;
  const auto add = [&](Index i) {
    if (particles.kind[i] != ParticleKind::solid || i == particle) return;
    const bool fits = !same_material || particles.material[i] == particles.material[particle];
    if (fits) neighbors.push_back(i);
  };
  for (Index e = 0; e < network.first_contact(); ++e) {
    const Index i = network.bonds.first[e], j = network.bonds.second[e];
    if (i == particle || j == particle) add(i == particle ? j : i);
  }
  for (Index i = 0; network.bonds.size() == 0 && i < particles.size(); ++i) add(i);
  const double farthest = gauge_reach * spacing_around(model, particle);
  std::erase_if(neighbors, [&](Index i) { return away(i, point) >= std::pow(farthest, 2); });
  std::stable_sort(neighbors.begin(), neighbors.end(),
                   [&](Index i, Index j) { return away(i, point) < away(j, point); });
  return neighbors;
}

/// Returns interpolation weights of a particle and its neighbours at a point. They are barycentric
/// coordinates in the line, triangle or tetrahedron of the nearest ones around it. No weight is
/// negative: a point outside is projected to the border.
std::vector<Gauge::Term> linear_terms(const Model& model, Index nearest, const Vector3& point,
                                      bool same_material) {
  constexpr double flat = 0.25, little = 1e-9;
  const Particles& particles = model.network.places();
  const double spacing = model.lattice.spacing;
  const auto from_nearest = [&](const auto& x) {
    Eigen::VectorXd way(particles.dim);
    for (int a = 0; a < particles.dim; ++a) way[a] = x[a] - particles.position(nearest)[a];
    return way;
  };
  const Eigen::VectorXd wanted = from_nearest(point);
  Eigen::MatrixXd ways(particles.dim, 0);
  Eigen::VectorXd weights(0);
  std::vector<Index> chosen;
  for (const Index i : neighbors_of(model, nearest, point, same_material)) {
    if (ways.cols() == particles.dim || (wanted - ways * weights).norm() <= little * spacing) break;
    const Eigen::VectorXd way = from_nearest(particles.position(i));
    if (ways.cols() > 0) {
      const Eigen::VectorXd along = least_squares_by_qr(ways, way);
      if ((way - ways * along).norm() < flat * spacing) continue;
    }
    Eigen::MatrixXd more = ways;
    more.conservativeResize(Eigen::NoChange, ways.cols() + 1);
    more.rightCols(1) = way;
    const Eigen::VectorXd next = least_squares_by_qr(more, wanted);
    if (next.minCoeff() < -little || next.sum() > 1.0 + little) continue;
    ways = more;
    weights = next;
    chosen.push_back(i);
  }
  std::vector<Gauge::Term> terms = {{nearest, 1.0 - weights.sum()}};
  for (std::size_t k = 0; k < chosen.size(); ++k) {
    terms.push_back({chosen[k], weights[static_cast<Index>(k)]});
  }
  std::erase_if(terms, [&](const Gauge::Term& term) { return std::abs(term.weight) < little; });
  return terms;
}

/// \param notes  receives a note where the point does not lie between particles
std::vector<Gauge::Term> terms_at(const CaseFile& input, const Model& model, const std::string& key,
                                  const Vector3& point, const Gauge& gauge,
                                  std::vector<std::string>& notes) {
  constexpr double moved = 1e-6;  // spacings within which a particle lies at the point
  const Particles& particles = model.network.places();
  const double spacing = model.lattice.spacing;
  const std::span<const double> at(point.data(), static_cast<std::size_t>(particles.dim));
  const NearestParticle nearest = nearest_particle(particles, at);
  if (const double around = spacing_around(model, nearest.particle); nearest.distance > around) {
    throw InputError(
        input.where(key),
        fmt::format("the point ({}) is {:.6g} from the nearest particle", joined(at),
                    nearest.distance),
        fmt::format("the spacing there is {:.6g}; place the point within this distance "
                    "of a particle",
                    around));
  }
  if (nearest.distance <= moved * spacing) return {{nearest.particle, 1.0}};
  std::vector<Gauge::Term> terms =
      linear_terms(model, nearest.particle, point, gauge.stress.has_value());
  const Vector3 place = place_of(particles, terms);
  if (norm(minus(place, point)) > moved * spacing) {
    notes.push_back(fmt::format(
        "the point {} of the gauge \"{}\" does not lie between particles: it measures at {}",
        point_text(point, particles.dim), gauge.name, point_text(place, particles.dim)));
  }
  return terms;
}

/// Sets up a gauge of the displacement of its second point relative to the first.
void fill_difference(const CaseFile& input, const Model& model, const std::string& key,
                     const GaugeSection& section, Gauge& gauge, std::vector<std::string>& notes) {
  const Particles& particles = model.network.particles;
  std::array<Vector3, 2> ends = {section.between[0], section.between[1]};
  std::array<Index, 2> nearest{};
  for (const std::size_t k : {0U, 1U}) {
    std::vector<Gauge::Term> terms = terms_at(input, model, key, ends[k], gauge, notes);
    nearest[k] = nearest_particle(model.network.places(),
                                  {ends[k].data(), static_cast<std::size_t>(particles.dim)})
                     .particle;
    gauge.place +=
        (k == 0 ? "from " : " to ") + point_text(place_of(particles, terms), particles.dim);
    // Points of a shell are given on its flat reference; particles lie in space.
    if (model.network.shell) ends[k] = place_of(particles, terms);
    for (Gauge::Term& term : terms) term.weight *= k == 0 ? -1.0 : 1.0;
    gauge.terms.insert(gauge.terms.end(), terms.begin(), terms.end());
  }
  if (nearest[0] == nearest[1]) {
    throw InputError(input.where(key), "gives two points with the same nearest particle",
                     "move the points apart or refine the spacing");
  }
  if (section.axis) return;
  const auto& [a, b] = ends;
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
                     fmt::format("is \"{}\", which contains only bars", section.region),
                     "name a region with particles of the solid");
  }
  for (const Index i : members) {
    if (is_bar(i) && !bars_alone) continue;
    gauge.terms.push_back({i, particles.volumes[i]});
    whole += particles.volumes[i];
  }
  for (Gauge::Term& term : gauge.terms) term.weight /= whole;
  const Particles& in_space = model.network.particles;
  gauge.place = gauge.terms.size() == 1
                    ? "at " + point_text(place_of(in_space, gauge.terms), in_space.dim)
                    : fmt::format("mean of {} particles", gauge.terms.size());
}

/// Sets up a gauge of the force on the particles of a region: of its supports, else of its loads.
/// Supports across the axis of a force do not count: one of a symmetry plane holds a loaded corner.
void fill_force(const CaseFile& input, const Model& model, const std::string& key,
                const GaugeSection& section, Gauge& gauge, std::vector<std::string>& notes) {
  const std::vector<std::uint8_t> held = held_slots(model);
  ModelState loaded;
  const std::vector<double> factors(model.sets.size(), 1.0);
  loaded.set_factors = factors;
  const std::vector<double> loads = present_loads(model, loaded);
  const auto width = static_cast<std::size_t>(model.network.width());
  bool any = false, is_held = false, is_loaded = false;
  for (const Index i : particles_of_region(input, model, section.reaction, key)) {
    gauge.terms.push_back({i, 1.0});
    for (std::size_t c = 0; c < width; ++c) {
      const bool holds = held[i * width + c] != 0, loads_it = loads[i * width + c] != 0.0;
      any = any || holds || loads_it;
      if (section.axis && !section.about && c != static_cast<std::size_t>(*section.axis)) continue;
      is_held = is_held || holds;
      is_loaded = is_loaded || loads_it;
    }
  }
  if (!any) {
    throw InputError(
        input.where(key),
        fmt::format("is \"{}\", whose particles have neither supports nor loads", section.reaction),
        "name a region of [[supports]], [[displacements]], [[velocities]], [[springs]] "
        "or of loads");
  }
  // Pins take no load: without supports they alone hold the body.
  const bool pinned = input.supports.empty() && input.displacements.empty() &&
                      input.springs.empty() && input.symmetry.empty();
  if (is_loaded && pinned) is_held = false;
  if (is_held && is_loaded) {
    notes.push_back(
        fmt::format("the region \"{}\" of the gauge \"{}\" has supports and loads: it measures the "
                    "reaction",
                    section.reaction, gauge.name));
  }
  gauge.force = is_loaded && !is_held ? Gauge::Force::load : Gauge::Force::reaction;
  gauge.about = section.about;
  if (section.about && model.network.shell) {
    const Vector3& flat = *section.about;
    gauge.about = point_on_shell(flat[0], flat[1], input.body.radius.value_or(0.0));
  }
  if (section.about && !section.axis) gauge.direction[2] = 1.0;  // in the plane
  const bool is_load = gauge.force == Gauge::Force::load;
  gauge.place =
      fmt::format("{} on {} particles", is_load ? "load" : "reaction", gauge.terms.size());
}

void fill_cracks(const CaseFile& input, const Model& model, const std::string& key,
                 const std::string& region, Gauge& gauge) {
  std::vector<std::uint8_t> marked(static_cast<std::size_t>(model.network.particles.size()), 0);
  for (const Index i : particles_of_region(input, model, region, key)) marked[i] = 1;
  gauge.place = "no cracks in an elastic analysis";  // the value is zero
  if (input.analysis.type == AnalysisType::elastic) return;
  gauge.cracks = crack_shares(input, model, marked);
  if (gauge.cracks.empty()) {
    throw InputError(
        input.where(key), fmt::format("is \"{}\", where no bond can crack", region),
        "name a region that contains bonds of a breakable material, which do not crush");
  }
  gauge.place = fmt::format("cracks of {} bonds", gauge.cracks.size());
}

/// Returns the index of a component among the six of a Stress.
std::size_t number_of(const std::array<int, 2>& axes) {
  if (axes[0] == axes[1]) return axes[0];
  return axes[0] == 1 ? 4 : axes[1] == 1 ? 3 : 5;
}

}  // namespace

std::vector<Gauge> build_gauges(const CaseFile& input, const Model& model,
                                std::vector<std::string>& notes) {
  std::vector<Gauge> gauges;
  const std::vector<std::string> taken = history_columns(input);
  for (std::size_t k = 0; k < input.gauges.size(); ++k) {
    const GaugeSection& section = input.gauges[k];
    if (std::find(taken.begin(), taken.end(), section.name) != taken.end()) {
      throw InputError(input.where(item_key("gauges", k, "name")),
                       fmt::format("is \"{}\", a column of every history", section.name),
                       "choose another name");
    }
    Gauge gauge;
    gauge.name = section.name;
    gauge.stress = section.stress;
    if (section.axis) gauge.direction[*section.axis] = 1.0;
    if (section.at) {
      const std::string key = item_key("gauges", k, "at");
      gauge.terms = terms_at(input, model, key, *section.at, gauge, notes);
      const Particles& particles = model.network.particles;
      gauge.place = "at " + point_text(place_of(particles, gauge.terms), particles.dim);
    } else if (!section.reaction.empty()) {
      fill_force(input, model, item_key("gauges", k, "reaction"), section, gauge, notes);
    } else if (!section.cracks.empty()) {
      fill_cracks(input, model, item_key("gauges", k, "cracks"), section.cracks, gauge);
    } else if (!section.region.empty()) {
      fill_mean(input, model, item_key("gauges", k, "region"), section, gauge);
    } else {
      fill_difference(input, model, item_key("gauges", k, "between"), section, gauge, notes);
    }
    gauges.push_back(std::move(gauge));
  }
  return gauges;
}

StressInput stress_input(const Model& model, const Csr& neighbourhoods, Secants secants) {
  // The fit at the surface is in equilibrium for one modulus.
  const bool fits_surface = !model.surface_conditions.empty() && model.modulus.empty();
  return {model.network,
          neighbourhoods,
          model.problem,
          model.hooke,
          model.elements.has_value(),
          secants,
          fits_surface ? &model.surface_conditions : nullptr,
          model.modulus};
}

bool measures_reactions(std::span<const Gauge> gauges) {
  return std::ranges::any_of(
      gauges, [](const Gauge& gauge) { return gauge.force == Gauge::Force::reaction; });
}

double gauge_force(const Model& model, const Gauge& gauge, const ModelState& state,
                   std::span<const double> holding) {
  std::vector<Index> particles;
  for (const Gauge::Term& term : gauge.terms) particles.push_back(term.particle);
  const bool is_load = gauge.force == Gauge::Force::load;
  const std::vector<double> loads = is_load ? present_loads(model, state) : std::vector<double>{};
  const Reaction sum = reaction_on(model, particles, is_load ? loads : holding);
  const Vector3 value = gauge.about ? about(*gauge.about, sum).moment : sum.force;
  return value[0] * gauge.direction[0] + value[1] * gauge.direction[1] +
         value[2] * gauge.direction[2];
}

std::vector<double> gauge_values(const Model& model, const ModelState& state, Csr& neighbourhoods,
                                 std::vector<double> holding) {
  const std::size_t width = model.network.width();
  std::vector<double> values;
  if (holding.empty() && measures_reactions(model.gauges)) holding = holding_forces(model, state);
  for (const Gauge& gauge : model.gauges) {
    if (gauge.force != Gauge::Force::none) {
      values.push_back(gauge_force(model, gauge, state, holding));
      continue;
    }
    if (!gauge.cracks.empty()) {
      values.push_back(crack_size(model.network, gauge.cracks, state.secants));
      continue;
    }
    if (!gauge.stress) {
      values.push_back(state.scale * gauge_value(gauge, model.network.dim(), [&](Index i, int a) {
                         return state.motion[i * width + a];
                       }));
      continue;
    }
    const std::size_t component = number_of(*gauge.stress);
    double value = 0.0;
    if (neighbourhoods.rows() == 0) {
      neighbourhoods = bonds_of_particles(model.network.bonds, model.network.particles.size());
    }
    const StressInput input = stress_input(model, neighbourhoods, state.secants);
    for (const Gauge::Term& term : gauge.terms) {
      value += term.weight * stress_at(input, state.motion, term.particle)[component];
    }
    values.push_back(state.scale * value);
  }
  return values;
}

std::optional<std::string> met_rule(const CaseFile& input, const StopSection& stop,
                                    std::span<const double> values) {
  if (stop.gauge.empty() || values.empty()) return std::nullopt;
  const auto gauge = std::ranges::find(input.gauges, stop.gauge, &GaugeSection::name);
  const double value = values[static_cast<std::size_t>(gauge - input.gauges.begin())];
  const bool is_above = stop.above && value >= *stop.above;
  if (!is_above && !(stop.below && value <= *stop.below)) return std::nullopt;
  return fmt::format("the gauge \"{}\" is {:.6g}, {} {}", stop.gauge, value,
                     is_above ? "above" : "below", is_above ? *stop.above : *stop.below);
}

}  // namespace perilink
