#include "results/field_file.hpp"

#include <algorithm>
#include <array>
#include <string>
#include <utility>
#include <vector>

#include "assembly/fields.hpp"
#include "material/principal_values.hpp"

namespace perilink {
namespace {

/// Pads rows of `dim` numbers with zeros to rows of three, which VTK requires for vectors.
std::vector<double> padded_to_three(std::span<const double> values, int dim) {
  const std::size_t width = static_cast<std::size_t>(dim);
  std::vector<double> padded(values.size() / width * 3, 0.0);
  for (std::size_t k = 0; k < values.size(); ++k) padded[k / width * 3 + k % width] = values[k];
  return padded;
}

template <class T>
std::vector<double> as_doubles(const std::vector<T>& values) {
  std::vector<double> numbers(values.size());
  std::transform(values.begin(), values.end(), numbers.begin(),
                 [](T value) { return static_cast<double>(value); });
  return numbers;
}

void append_cell(VtuGrid& grid, VtuCell type, std::span<const Index> points, FieldElement element,
                 double broken_at) {
  grid.types.push_back(type);
  grid.connectivity.insert(grid.connectivity.end(), points.begin(), points.end());
  grid.offsets.push_back(static_cast<Index>(grid.connectivity.size()));
  grid.cell_data[0].values.push_back(static_cast<double>(element));
  grid.cell_data[1].values.push_back(broken_at);
  for (std::size_t k = 2; k < grid.cell_data.size(); ++k) grid.cell_data[k].values.push_back(0.0);
}

VtuCell cell_of(std::size_t dim, std::size_t corners) {
  if (corners == 2) return VtuCell::line;
  if (corners == dim + 1) return dim == 2 ? VtuCell::triangle : VtuCell::tetrahedron;
  return dim == 2 ? VtuCell::quadrilateral : VtuCell::hexahedron;
}

void append_cells(VtuGrid& grid, const Network& network, std::span<const Index> broken_elements) {
  grid.cell_data = {{"element", 1, {}}, {"broken_at", 1, {}}};
  for (Index i = 0; i < network.particles.size(); ++i) {
    append_cell(grid, VtuCell::vertex, {&i, 1}, FieldElement::particle, 0.0);
  }
  const auto ends = [&](Index b) {
    return std::array{network.bonds.first[b], network.bonds.second[b]};
  };
  double broken_at = 0.0;
  for (const Index b : broken_elements) {
    append_cell(grid, VtuCell::line, ends(b), FieldElement::broken_bond, broken_at += 1.0);
  }
  for (Index b = network.first_bar_element; b < network.num_elements(); ++b) {
    append_cell(grid, VtuCell::line, ends(b), FieldElement::rebar_segment, 0.0);
  }
  for (Index k = 0; network.cells && k < network.cells->cells.size(); ++k) {
    const auto cell = network.cells->cells.cell(k);
    append_cell(grid, cell_of(static_cast<std::size_t>(network.dim()), cell.size()), cell,
                FieldElement::cell, 0.0);
  }
}

/// Returns half of stress times strain of every cell.
std::vector<double> energy_densities(std::span<const double> strains,
                                     std::span<const double> stresses, int dim) {
  const std::size_t width = static_cast<std::size_t>(dim) * dim;
  std::vector<double> densities(strains.size() / width, 0.0);
  for (std::size_t k = 0; k < strains.size(); ++k) {
    densities[k / width] += 0.5 * stresses[k] * strains[k];
  }
  return densities;
}

std::vector<std::pair<std::string, double>> field_data_of(const FieldMoment& moment, int dim) {
  std::vector<std::pair<std::string, double>> data = {
      {"step", static_cast<double>(moment.step)},
      {"broken_bonds", static_cast<double>(moment.broken_bonds)},
      {"load_factor", moment.load_factor},
      {"load", moment.load},
      {"dimension", static_cast<double>(dim)},
      {"spacing", moment.spacing},
  };
  if (moment.time) data.emplace_back("time", *moment.time);
  if (moment.thickness) data.emplace_back("thickness", *moment.thickness);
  return data;
}

/// Returns the volumes, zero for embedded points: their volume is that of a particle.
std::vector<double> volumes_of_particles(const Particles& particles) {
  std::vector<double> volumes = particles.volumes;
  for (std::size_t i = 0; i < volumes.size(); ++i) {
    if (particles.kind[i] == ParticleKind::embedded_point) volumes[i] = 0.0;
  }
  return volumes;
}

}  // namespace

VtuGrid make_field_grid(const Network& network, Secants secants, std::span<const double> motion,
                        const FieldMoment& moment, std::span<const Index> broken_elements_in_order,
                        const Csr& neighbourhoods) {
  const int dim = network.dim();
  const std::vector<double> displacement = translations(network, motion);

  VtuGrid grid;
  grid.points = padded_to_three(network.particles.positions, dim);
  append_cells(grid, network, broken_elements_in_order);
  grid.point_data = {
      {"displacement", 3, padded_to_three(displacement, dim)},
      {"damage", 1, particle_damage(network, neighbourhoods, secants)},
      {"region", 1, as_doubles(network.particles.material)},
      {"kind", 1, as_doubles(network.particles.kind)},
      {"volume", 1, volumes_of_particles(network.particles)},
      {"strain_energy_density", 1, strain_energy_density(network, secants, motion, moment.strain)},
      {"principal_strain", 3,
       network.shell ? face_strains(network, neighbourhoods, secants, motion)
                     : padded_to_three(principal_strains(network, neighbourhoods, secants,
                                                         displacement, moment.strain),
                                       dim)},
  };
  if (network.carries_moments()) {
    grid.point_data.push_back({"rotation", dim == 2 ? 1 : 3, rotations(network, motion)});
  }
  grid.field_data = field_data_of(moment, dim);
  return grid;
}

void add_bars(VtuGrid& grid, const BarState& bars) {
  const std::vector<double>& element = grid.cell_data[0].values;
  const auto first = static_cast<std::size_t>(
      std::find(element.begin(), element.end(), static_cast<double>(FieldElement::rebar_segment)) -
      element.begin());
  const auto add = [&](const char* name, const std::vector<double>& of_segments) {
    std::vector<double> all(grid.types.size(), 0.0);
    std::copy(of_segments.begin(), of_segments.end(),
              all.begin() + static_cast<std::ptrdiff_t>(first));
    grid.cell_data.push_back({name, 1, std::move(all)});
  };
  add("axial_strain", bars.strain);
  add("axial_force", bars.force);
  add("axial_stress", bars.stress);
  add("slip", bars.slip);
  add("bond_stress", bars.bond_stress);
}

void add_stresses(VtuGrid& grid, std::vector<double> stresses, int dim) {
  constexpr std::size_t width = SymmetricTensor{}.size();
  const std::size_t count = stresses.size() / width;
  std::vector<double> principal(3 * count), first(3 * count), last(3 * count);
#pragma omp parallel for schedule(static)
  for (std::size_t i = 0; i < count; ++i) {
    SymmetricTensor stress{}, opposite{};
    for (std::size_t c = 0; c < width; ++c) opposite[c] = -(stress[c] = stresses[i * width + c]);
    const PrincipalValues values = principal_values(stress, dim);
    const auto at = static_cast<std::ptrdiff_t>(3 * i);
    std::ranges::copy(Vector3{values.first, values.middle, dim == 2 ? 0.0 : values.last},
                      principal.begin() + at);
    std::ranges::copy(principal_direction(stress, dim), first.begin() + at);
    std::ranges::copy(principal_direction(opposite, dim), last.begin() + at);
  }
  grid.point_data.push_back({"stress", 6, std::move(stresses)});
  grid.point_data.push_back({"principal_stress", 3, std::move(principal)});
  grid.point_data.push_back({"first_principal_direction", 3, std::move(first)});
  grid.point_data.push_back({"last_principal_direction", 3, std::move(last)});
}

void add_section_forces(VtuGrid& grid, SectionForces forces) {
  grid.point_data.push_back({"normal_force", 1, std::move(forces.normal)});
  grid.point_data.push_back({"shear_force", 1, std::move(forces.shear)});
  grid.point_data.push_back({"bending_moment", 1, std::move(forces.moment)});
}

void add_openings(VtuGrid& grid, const Network& network, const CrackOpenings& openings,
                  std::span<const Index> broken_elements_in_order) {
  grid.point_data.push_back({"crack_opening", 1, openings_at_particles(network, openings)});
  std::vector<double> of_cells(grid.types.size(), 0.0);
  std::size_t cell = network.particles.volumes.size();
  for (const Index e : broken_elements_in_order) {
    const auto place = std::lower_bound(openings.bonds.begin(), openings.bonds.end(), e);
    if (place != openings.bonds.end() && *place == e) {
      of_cells[cell] = openings.opening[static_cast<std::size_t>(place - openings.bonds.begin())];
    }
    ++cell;
  }
  grid.cell_data.push_back({"crack_opening", 1, std::move(of_cells)});
}

void add_hosts(VtuGrid& grid, const Particles& particles, const Hosts& hosts,
               std::span<const std::uint8_t> whole) {
  const auto dim = static_cast<std::size_t>(particles.dim);
  std::vector<Index> corners;
  for (Index e = 0; e < hosts.size(); ++e) {
    if (whole[e] == 0) continue;
    corners.clear();
    for (const Index node : hosts.corners_of.row(e)) {
      const auto away = [&](Index i) {
        double square = 0.0;
        for (std::size_t a = 0; a < dim; ++a) {
          const double gap =
              particles.position(i)[a] - hosts.nodes[static_cast<std::size_t>(node) * dim + a];
          square += gap * gap;
        }
        return square;
      };
      const auto inside = hosts.inside.row(e);
      corners.push_back(*std::min_element(inside.begin(), inside.end(),
                                          [&](Index i, Index j) { return away(i) < away(j); }));
    }
    append_cell(grid, cell_of(dim, corners.size()), corners, FieldElement::host, 0.0);
  }
}

void add_body_cells(VtuGrid& grid, const Csr& corners, int dim) {
  for (Index k = 0; k < corners.rows(); ++k) {
    const auto cell = corners.row(k);
    append_cell(grid, cell_of(static_cast<std::size_t>(dim), cell.size()), cell, FieldElement::body,
                0.0);
  }
}

void number_cracks(VtuGrid& grid, std::span<const Index> cracked) {
  for (VtuArray& field : grid.cell_data) {
    if (field.name != "broken_at") continue;
    for (std::size_t k = 0; k < cracked.size(); ++k) {
      field.values[cracked[k]] = static_cast<double>(k + 1);
    }
  }
}

VtuGrid make_element_grid(const LinearElements& elements, const Particles& particles,
                          std::span<const double> motion, const FieldMoment& moment) {
  const int dim = particles.dim;
  const std::vector<double> strains = cell_strains(elements, motion);
  const std::vector<double> stresses = cell_stresses(elements, strains);
  const std::vector<double> densities = energy_densities(strains, stresses, dim);
  const std::vector<double> principal = principal_values(strains, dim);

  VtuGrid grid;
  grid.points = padded_to_three(particles.positions, dim);
  grid.cell_data = {{"element", 1, {}}, {"broken_at", 1, {}}};
  for (Index i = 0; i < particles.size(); ++i) {
    append_cell(grid, VtuCell::vertex, {&i, 1}, FieldElement::particle, 0.0);
  }
  for (Index number = 0; number < elements.cells.size(); ++number) {
    append_cell(grid, dim == 2 ? VtuCell::triangle : VtuCell::tetrahedron,
                elements.cells.cell(number), FieldElement::cell, 0.0);
  }
  const auto after_vertices = [&](const char* name, int width, const std::vector<double>& values) {
    std::vector<double> all(particles.volumes.size() * static_cast<std::size_t>(width), 0.0);
    all.insert(all.end(), values.begin(), values.end());
    grid.cell_data.push_back({name, width, std::move(all)});
  };
  after_vertices("strain_energy_density", 1, densities);
  after_vertices("principal_strain", 3, padded_to_three(principal, dim));
  after_vertices("principal_stress", 3, padded_to_three(principal_values(stresses, dim), dim));
  const std::vector<double> mean_strains =
      averaged_at_particles(elements, strains, static_cast<std::size_t>(dim) * dim);
  grid.point_data = {
      {"displacement", 3, padded_to_three(motion, dim)},
      {"damage", 1, std::vector<double>(particles.volumes.size(), 0.0)},
      {"region", 1, as_doubles(particles.material)},
      {"kind", 1, as_doubles(particles.kind)},
      {"volume", 1, particles.volumes},
      {"strain_energy_density", 1, averaged_at_particles(elements, densities, 1)},
      {"principal_strain", 3, padded_to_three(principal_values(mean_strains, dim), dim)},
  };
  grid.field_data = field_data_of(moment, dim);
  return grid;
}

}  // namespace perilink
