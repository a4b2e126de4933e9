#include "crack_path.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>

#include "assembly/fields.hpp"

namespace perilink::verification {
namespace {

/// Damaged particles of a row that stand together.
struct Cluster {
  double along = 0.0, across = 0.0;  ///< [length]
  double damage = 0.0;               ///< sum over the particles
};

using Rows = std::map<int, std::vector<Cluster>>;  ///< by number of the row

std::vector<double> damage_of(const Model& model, std::span<const Index> broken_bonds) {
  const Network& network = model.network;
  std::vector<double> secants(static_cast<std::size_t>(network.num_elements()), 1.0);
  for (const Index b : broken_bonds) secants[b] = 0.0;
  return particle_damage(network, bonds_of_particles(network.bonds, network.particles.size()),
                         secants);
}

/// Particles of the ligament with at least `least` damage, those of each row gathered where less
/// than a horizon lies between them.
Rows damaged_rows(const Specimen& specimen, const Model& model, std::span<const double> damage,
                  double least) {
  const Particles& particles = model.network.particles;
  const int along = specimen.along;
  const double h = model.lattice.spacing, margin = 1e-6 * h;
  std::map<int, std::map<double, double>> of_rows;  // damage by place across
  double first = INFINITY;
  for (Index i = 0; i < particles.size(); ++i) {
    if (particles.kind[i] == ParticleKind::solid)
      first = std::min(first, particles.position(i)[along]);
  }
  for (Index i = 0; i < particles.size(); ++i) {
    const auto x = particles.position(i);
    if (particles.kind[i] != ParticleKind::solid || damage[i] < least) continue;
    if (x[along] < specimen.ligament[0] - margin || x[along] > specimen.ligament[1] + margin)
      continue;
    of_rows[static_cast<int>(std::lround((x[along] - first) / h))][x[1 - along]] = damage[i];
  }
  Rows rows;
  for (const auto& [number, places] : of_rows) {
    std::vector<Cluster>& clusters = rows[number];
    double last = -INFINITY;
    for (const auto& [across, part] : places) {
      if (across - last > model.horizon) clusters.push_back({first + number * h, 0.0, 0.0});
      Cluster& cluster = clusters.back();
      cluster.across = (cluster.across * cluster.damage + across * part) / (cluster.damage + part);
      cluster.damage += part;
      last = across;
    }
  }
  return rows;
}

/// Follows the crack from one row on, `step` rows up or down at a time.
void follow(const Rows& rows, int row, Cluster here, int step, double horizon, double spacing,
            std::vector<CrackedRow>& path) {
  const int reach = static_cast<int>(std::lround(horizon / spacing));
  for (int gap = 1; gap <= reach; ++gap) {
    const auto found = rows.find(row + step * gap);
    if (found == rows.end()) continue;
    const auto away = [&](const Cluster& c) { return std::abs(c.across - here.across); };
    const Cluster next =
        *std::min_element(found->second.begin(), found->second.end(),
                          [&](const auto& a, const auto& b) { return away(a) < away(b); });
    if (away(next) > 2.0 * horizon) continue;
    path.push_back({next.along, next.across});
    row = found->first;
    here = next;
    gap = 0;
  }
}

double fracture_energy_at(const Specimen& specimen, const CrackedRow& row) {
  if (!specimen.weak) return specimen.fracture_energy;
  std::array<double, 2> x{};
  x[specimen.along] = row.along;
  x[1 - specimen.along] = row.across;
  return specimen.weak->contains(x, 0.0) ? specimen.weak_fracture_energy : specimen.fracture_energy;
}

/// Length per extent of the polygon through the means of `count` rows each.
double slope_factor(const std::vector<CrackedRow>& rows, std::size_t count) {
  std::vector<CrackedRow> means;
  for (std::size_t k = 0; k + count <= rows.size(); k += count) {
    CrackedRow mean;
    for (std::size_t r = k; r < k + count; ++r) {
      mean.along += rows[r].along / static_cast<double>(count);
      mean.across += rows[r].across / static_cast<double>(count);
    }
    means.push_back(mean);
  }
  if (means.size() < 2) return 1.0;
  double length = 0.0;
  for (std::size_t k = 1; k < means.size(); ++k) {
    length +=
        std::hypot(means[k].along - means[k - 1].along, means[k].across - means[k - 1].across);
  }
  return length / (means.back().along - means.front().along);
}

}  // namespace

double damage_beside_plane_crack(const Lattice& lattice, double horizon, int across) {
  const InteriorNeighbourhood neighbourhood = interior_neighbourhood(lattice, horizon);
  const auto lost =
      std::count_if(neighbourhood.offsets.begin(), neighbourhood.offsets.end(),
                    [&](const Vector3& xi) { return xi[across] > 1e-6 * lattice.spacing; });
  return static_cast<double>(lost) / static_cast<double>(neighbourhood.offsets.size());
}

CrackPath find_crack(const Specimen& specimen, const Model& model,
                     std::span<const Index> broken_bonds) {
  const double h = model.lattice.spacing;
  const double least =
      0.5 * damage_beside_plane_crack(model.lattice, model.horizon, 1 - specimen.along);
  const Rows rows = damaged_rows(specimen, model, damage_of(model, broken_bonds), least);
  CrackPath path;
  int start = 0;
  std::optional<Cluster> most;
  for (const auto& [number, clusters] : rows) {
    for (const Cluster& cluster : clusters) {
      if (most && cluster.damage <= most->damage) continue;
      most = cluster;
      start = number;
    }
  }
  if (!most) return path;
  follow(rows, start, *most, -1, model.horizon, h, path.rows);
  std::reverse(path.rows.begin(), path.rows.end());
  path.rows.push_back({most->along, most->across});
  follow(rows, start, *most, 1, model.horizon, h, path.rows);

  const auto [low, high] = specimen.ligament;
  const double factor =
      slope_factor(path.rows, static_cast<std::size_t>(std::lround(model.horizon / h)));
  path.extent = std::min(path.rows.back().along + 0.5 * h, high) -
                std::max(path.rows.front().along - 0.5 * h, low);
  path.length = factor * path.extent;
  for (const CrackedRow& row : path.rows) {
    path.energy += fracture_energy_at(specimen, row) / static_cast<double>(path.rows.size());
  }
  path.energy *= path.length * specimen.thickness;
  return path;
}

StrayBreaks find_stray_breaks(const Specimen& specimen, const CrackPath& path, const Model& model,
                              std::span<const Index> broken_bonds) {
  const Bonds& bonds = model.network.bonds;
  const int along = specimen.along;
  const double near = (model.horizon + model.lattice.spacing) * (1.0 + 1e-6);
  StrayBreaks stray;
  for (const Index b : broken_bonds) {
    const auto x = model.network.particles.position(bonds.first[b]);
    const auto y = model.network.particles.position(bonds.second[b]);
    const std::array<double, 2> middle = {0.5 * (x[0] + y[0]), 0.5 * (x[1] + y[1])};
    double distance = INFINITY;
    for (const CrackedRow& row : path.rows) {
      distance =
          std::min(distance, std::hypot(middle[along] - row.along, middle[1 - along] - row.across));
    }
    if (distance > near) {
      const bool at_notch =
          std::any_of(specimen.corners.begin(), specimen.corners.end(),
                      [&](const std::array<double, 2>& corner) {
                        return std::hypot(middle[0] - corner[0], middle[1] - corner[1]) <= near;
                      });
      ++(at_notch ? stray.at_notch : stray.elsewhere);
    }
    if (distance <= stray.farthest) continue;
    stray.farthest = distance;
    stray.place = middle;
  }
  return stray;
}

double plane_crack_energy_ratio(const Specimen& specimen, const Model& model) {
  const Network& network = model.network;
  Index inside = 0;
  double least = INFINITY;
  for (Index i = 0; i < network.particles.size(); ++i) {
    const auto x = network.particles.position(i);
    const double distance = std::hypot(x[0] - specimen.inside[0], x[1] - specimen.inside[1]);
    if (distance < least) {
      least = distance;
      inside = i;
    }
  }
  double energy = 0.0;
  for (Index b = 0; b < network.bonds.size(); ++b) {
    if (network.bonds.first[b] != inside && network.bonds.second[b] != inside) continue;
    const double stretched = network.bonds.lengths[b] * network.critical_stretch[b];
    const double across =
        network.bonds.lengths[b] * std::abs(network.bonds.direction(b)[1 - specimen.along]);
    // |xi . e| / V bonds of each kind cross a unit of area; a family has each kind twice.
    energy += 0.5 * 0.5 * network.stiffness[b] * stretched * stretched * across;
  }
  return energy / model.lattice.cell_volume / specimen.fracture_energy;
}

}  // namespace perilink::verification
