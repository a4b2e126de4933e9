#include "model/body/host_model.hpp"

#include <fmt/format.h>

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "base/dense/decompositions.hpp"
#include "base/error.hpp"
#include "discretization/cuts/cracks.hpp"
#include "discretization/lattices/triangulate.hpp"
#include "discretization/neighbor_search.hpp"
#include "model/body/mesh_input.hpp"
#include "model/model_regions.hpp"
#include "network/builder/tied_cells.hpp"

namespace perilink {
namespace {

/// Distance within which a particle lies on the border of an element, in spacings.
constexpr double border_tolerance = 1e-6;

/// Smallest width of an element in spacings; smaller ones would contain no particle.
constexpr double least_spacings = 2.0;

bool carries_particles(const ElementsSection& section) {
  return section.spacings || section.size || section.mesh;
}

/// Returns planes between elements of about equal size. They pass through rows of evenly spaced
/// particles, as do the mid-side nodes where the body has enough rows.
std::vector<double> divide(const Model& model, int axis, double size, int order) {
  const Particles& particles = model.network.particles;
  double lower = particles.position(0)[axis], upper = lower;
  for (Index i = 0; i < particles.size(); ++i) {
    lower = std::min(lower, particles.position(i)[axis]);
    upper = std::max(upper, particles.position(i)[axis]);
  }
  const double extent = upper - lower;
  if (extent == 0.0) return {lower};  // a beam
  const double count = std::max(1.0, std::round(extent / size));
  const auto is_whole = [](double rows) {
    return rows > 0.5 && std::abs(rows - std::round(rows)) < border_tolerance * rows;
  };
  const double step = model.lattice.step[axis];
  double rows = step > 0.0 ? extent / (order * step) : 0.0;
  if (!is_whole(rows)) rows *= order;
  const bool even = is_whole(rows) && count <= std::round(rows);
  std::vector<double> planes;
  for (double k = 0.0; k <= count; k += 1.0) {
    const double at = k / count;
    planes.push_back(lower + (even ? std::round(at * rows) / std::round(rows) : at) * extent);
  }
  return planes;
}

double size_of_elements(const CaseFile& input, const Model& model) {
  const ElementsSection& section = *input.elements;
  const double spacing = model.lattice.spacing;
  const double size = section.size.value_or(section.spacings.value_or(0) * spacing);
  if (size < least_spacings * spacing * (1.0 - border_tolerance)) {
    throw InputError(
        input.where("elements.size"),
        fmt::format("is {:.6g}, but particles are {:.6g} apart", size, spacing),
        fmt::format("give at least {:.6g}, or spacings = 4", least_spacings * spacing));
  }
  return size;
}

/// Returns the centres of surface facets and of interfaces between materials of different
/// stiffness. Strains jump there, which elements cannot represent.
std::vector<double> faces_of(const Model& model) {
  std::vector<double> faces;
  for (Index f = 0; f < model.facets.size(); ++f) {
    const Index inside = model.facets.inside[f], outside = model.facets.outside[f];
    if (outside != no_index && model.hooke[inside].lambda == model.hooke[outside].lambda &&
        model.hooke[inside].mu == model.hooke[outside].mu) {
      continue;
    }
    const Vector3 centre = model.facets.centre(f, model.network.particles.positions);
    faces.insert(faces.end(), centre.begin(), centre.begin() + model.network.dim());
  }
  return faces;
}

/// \param notes  receives those of a mesh
Hosts find_hosts(const CaseFile& input, const Model& model, std::vector<std::string>& notes) {
  const ElementsSection& section = *input.elements;
  const Particles& particles = model.network.particles;
  const std::vector<double> faces = faces_of(model);
  const double tolerance = border_tolerance * model.lattice.spacing;
  if (section.mesh) {
    const Mesh mesh = read_mesh(input, "elements.mesh", section, particles.dim);
    notes.insert(notes.end(), mesh.notes.begin(), mesh.notes.end());
    try {
      return hosts_on_mesh(particles, faces, mesh, section.order, tolerance);
    } catch (const std::invalid_argument& error) {
      throw InputError(input.where("elements.mesh"),
                       fmt::format("names {}: {}", *section.mesh, error.what()), "");
    }
  }
  const double size = size_of_elements(input, model);
  Divisions divisions;
  for (int a = 0; a < particles.dim; ++a) divisions[a] = divide(model, a, size, section.order);
  return hosts_on_grid(particles, faces, divisions, section.order, tolerance);
}

/// Per particle, whether an element may constrain it.
std::vector<std::uint8_t> particles_to_carry(const CaseFile& input, const Model& model) {
  const ElementsSection& section = *input.elements;
  const auto count = static_cast<std::size_t>(model.network.particles.size());
  std::vector<std::uint8_t> carry(count, section.regions.empty() ? 1 : 0);
  for (const std::string& region : section.regions) {
    for (const Index i : particles_of_region(input, model, region, "elements.regions")) {
      carry[i] = 1;
    }
  }
  for (const std::string& region : section.particles) {
    for (const Index i : particles_of_region(input, model, region, "elements.particles")) {
      carry[i] = 0;
    }
  }
  const std::vector<std::uint8_t> in_cells = vertices_of_cells(model.network);
  for (std::size_t i = 0; i < in_cells.size(); ++i) {
    if (in_cells[i] != 0) carry[i] = 0;
  }
  return carry;
}

/// Returns pairs of near neighbours: the edges of mesh cells, and in lattices particles within 1.8
/// spacings.
Bonds nearest_pairs(const Model& model) {
  constexpr double nearest = 1.8;  // spacings
  const Particles& particles = model.network.particles;
  if (model.cells.size() > 0) return edges_of(model.cells, particles);
  const Csr neighbors =
      find_upper_neighbors(particles.positions, particles.dim, nearest * model.lattice.spacing);
  Bonds pairs;
  for (Index i = 0; i < neighbors.rows(); ++i) {
    for (const Index j : neighbors.row(i)) {
      pairs.first.push_back(i);
      pairs.second.push_back(j);
    }
  }
  return pairs;
}

/// Marks elements with a particle that a pre-crack separates from a near neighbour.
std::vector<std::uint8_t> cracked_elements(const Model& model, const Hosts& hosts) {
  std::vector<std::uint8_t> cracked(static_cast<std::size_t>(hosts.size()), 0);
  if (model.cracks.empty()) return cracked;
  const Particles& particles = model.network.particles;
  const Bonds pairs = nearest_pairs(model);
  const CutBonds cut = find_cut_bonds(particles, pairs, model.cracks, model.lattice.spacing);
  std::vector<std::uint8_t> beside(static_cast<std::size_t>(particles.size()), 0);
  for (std::size_t k = 0; k < pairs.first.size(); ++k) {
    if (cut.keep[k] == 0) beside[pairs.first[k]] = beside[pairs.second[k]] = 1;
  }
  for (Index e = 0; e < hosts.size(); ++e) {
    const auto inside = hosts.inside.row(e);
    cracked[e] = std::any_of(inside.begin(), inside.end(), [&](Index i) { return beside[i] != 0; });
  }
  return cracked;
}

/// Whether the particles of an element determine the displacements of all its nodes.
bool has_full_rank(const Hosts& hosts, Index element) {
  constexpr double least = 1e-3;  // smallest singular value over the largest
  const auto nodes = static_cast<Index>(hosts.nodes_of.row(element).size());
  const auto count = static_cast<Index>(hosts.inside.row(element).size());
  if (count < nodes) return false;
  using Weights = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  const Eigen::Map<const Weights> weights(hosts.weights_at(element, 0).data(), count, nodes);
  const Eigen::MatrixXd products = weights.transpose() * weights;
  const Eigen::VectorXd squares = eigenvalues(products);
  return squares[0] > least * least * squares[nodes - 1];
}

/// Whether a later stage prescribes a displacement of, or clamps, a particle of the element.
bool is_gripped_later(const Model& model, const EmbeddedBody& body, Index element) {
  for (const Index i : body.hosts.inside.row(element)) {
    for (int a = 0; a < body.free.width; ++a) {
      const std::size_t slot = static_cast<std::size_t>(i) * body.free.width + a;
      for (const LoadCase& set : model.sets) {
        if (set.unknowns.prescribed[slot] != 0.0) return true;
        if ((set.unknowns.number[slot] < 0) != (body.free.number[slot] < 0)) return true;
      }
    }
  }
  return false;
}

}  // namespace

void carry_particles(const CaseFile& input, Model& model) {
  if (!input.elements || !carries_particles(*input.elements)) return;
  EmbeddedBody body;
  body.hosts = find_hosts(input, model, model.notes);
  body.free = std::move(model.unknowns);
  body.release_threshold = input.elements->release_threshold;
  body.release_strain = input.elements->release_strain;
  body.buffer_zone = input.elements->buffer_zone.value_or(model.horizon);
  const std::vector<std::uint8_t> carry = particles_to_carry(input, model);
  const std::vector<std::uint8_t> cracked = cracked_elements(model, body.hosts);
  body.whole = fit_supports(body.hosts, body.free);
  for (Index e = 0; e < body.hosts.size(); ++e) {
    const auto inside = body.hosts.inside.row(e);
    const bool all = std::all_of(inside.begin(), inside.end(), [&](Index i) { return carry[i]; });
    if (!all || cracked[e] != 0 || is_gripped_later(model, body, e) ||
        !has_full_rank(body.hosts, e)) {
      body.whole[e] = 0;
    }
  }
  const auto whole = std::count(body.whole.begin(), body.whole.end(), 1);
  if (whole == 0) {
    throw InputError(input.where("elements"),
                     "leaves no element: surfaces, supports, cracks or regions cross all "
                     "elements, or each contains fewer particles than nodes",
                     "give a smaller size where they are crossed, a larger size where they "
                     "are only a spacing or two wide, or delete the table");
  }
  model.unknowns = embedded_motion(body.hosts, body.free, body.whole);
  model.embedded = std::move(body);
}

}  // namespace perilink
