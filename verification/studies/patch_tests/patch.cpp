#include "patch.hpp"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>

#include "analysis/quasistatic/elastic_analysis.hpp"
#include "assembly/distributed_loads.hpp"
#include "assembly/internal_force.hpp"
#include "io/case/case_file.hpp"
#include "network/rigid_modes.hpp"

namespace perilink::verification {
namespace {

/// Spin of a gradient of displacement: rotation about z in two dimensions, about the axes in three.
std::vector<double> spin(const Gradient& g) {
  if (g.size() == 2) return {0.5 * (g[1][0] - g[0][1])};
  return {0.5 * (g[2][1] - g[1][2]), 0.5 * (g[0][2] - g[2][0]), 0.5 * (g[1][0] - g[0][1])};
}

double component(const Gradient& g, std::span<const double> x, int a) {
  double sum = 0.0;
  for (std::size_t b = 0; b < x.size(); ++b) sum += g[a][b] * x[b];
  return sum;
}

/// Motion of all particles, shape (particles, width).
std::vector<double> uniform_motion(const Network& network, const Gradient& g) {
  const int dim = network.dim(), width = network.width();
  const std::vector<double> rotation = spin(g);
  std::vector<double> motion(static_cast<std::size_t>(network.particles.size()) * width, 0.0);
  for (Index i = 0; i < network.particles.size(); ++i) {
    const auto x = network.particles.position(i);
    for (int a = 0; a < dim; ++a) motion[i * width + a] = component(g, x, a);
    for (int a = dim; a < width; ++a) motion[i * width + a] = rotation[a - dim];
  }
  return motion;
}

std::vector<Gradient> unit_strains(int dim) {
  std::vector<Gradient> strains;
  for (int a = 0; a < dim; ++a) {
    for (int b = a; b < dim; ++b) {
      Gradient strain(dim, std::vector<double>(dim, 0.0));
      strain[a][b] = strain[b][a] = a == b ? 1.0 : 0.5;
      strains.push_back(strain);
    }
  }
  return strains;
}

double norm(const double* first, int count) {
  return std::sqrt(std::inner_product(first, first + count, first, 0.0));
}

/// Takes the rigid motion of least squares out of a field of differences, shape (particles, dim).
void remove_rigid_motion(const Particles& particles, Eigen::VectorXd& difference) {
  const int dim = particles.dim, modes = dim == 2 ? 3 : 6;
  Eigen::MatrixXd basis = Eigen::MatrixXd::Zero(difference.size(), modes);
  for (Index i = 0; i < particles.size(); ++i) {
    const auto x = particles.position(i);
    for (int a = 0; a < dim; ++a) basis(i * dim + a, a) = 1.0;
    for (int mode = dim, a = 0; a < dim; ++a) {
      for (int b = a + 1; b < dim; ++b, ++mode) {
        basis(i * dim + a, mode) = -x[b];
        basis(i * dim + b, mode) = x[a];
      }
    }
  }
  difference -= basis * basis.colPivHouseholderQr().solve(difference).eval();
}

/// Displacements less those of the study's gradient, shape (particles, dim).
Eigen::VectorXd difference_from_gradient(const Network& network, std::span<const double> motion) {
  const int dim = network.dim(), width = network.width();
  const std::vector<double> exact = uniform_motion(network, patch_gradient(dim));
  Eigen::VectorXd difference(network.particles.size() * dim);
  for (Index i = 0; i < network.particles.size(); ++i) {
    for (int a = 0; a < dim; ++a) {
      difference[i * dim + a] = motion[i * width + a] - exact[i * width + a];
    }
  }
  return difference;
}

double largest_displacement(const Network& network) {
  double largest = 0.0;
  for (Index i = 0; i < network.particles.size(); ++i) {
    const auto x = network.particles.position(i);
    for (int a = 0; a < network.dim(); ++a) {
      largest = std::max(largest, std::abs(component(patch_gradient(network.dim()), x, a)));
    }
  }
  return largest;
}

}  // namespace

Gradient patch_gradient(int dim) {
  if (dim == 2) return {{0.01, 0.004}, {0.002, -0.007}};
  return {{0.01, 0.004, -0.003}, {0.002, -0.007, 0.001}, {0.001, 0.002, 0.005}};
}

std::string patch_case(const PatchBody& body, const std::string& loading) {
  const Gradient g = patch_gradient(body.dim);
  const std::vector<double> rotation = spin(g);
  std::string held = "[[displacements]]\nregion = \"surface\"\n";
  for (int a = 0; a < body.dim; ++a) {
    held += fmt::format("{} = \"{}*x + {}*y{}\"\n", "xyz"[a], g[a][0], g[a][1],
                        body.dim == 3 ? fmt::format(" + {}*z", g[a][2]) : "");
  }
  if (body.micropolar && body.dim == 2) held += fmt::format("rotation = {:.17g}\n", rotation[0]);
  for (int a = 0; body.micropolar && body.dim == 3 && a < 3; ++a) {
    held += fmt::format("r{} = {:.17g}\n", "xyz"[a], rotation[a]);
  }
  const std::string region = !body.group.empty() ? fmt::format("group = \"{}\"\n", body.group)
                                                 : fmt::format("x = [0, 1.5]\ny = [0, 1]\n{}",
                                                               body.dim == 3 ? "z = [0, 1]\n" : "");
  return fmt::format(
      "[body]\n{}{}{}surface = \"calibrated\"\n[[regions]]\nname = \"solid\"\n{}"
      "[[materials]]\nregion = \"solid\"\nyoungs_modulus = 1\nfracture_energy = \"infinite\"\n{}"
      "{}[analysis]\ntype = \"elastic\"\nrigid_body_modes = \"pin\"\n",
      body.keys, body.dim == 3 ? "problem = \"three_dimensional\"\n" : "",
      body.micropolar ? "model = \"micropolar\"\n" : "", region,
      body.micropolar ? "poissons_ratio = 0.2\n" : "", loading.empty() ? held : loading);
}

Model patch_model(const PatchBody& body, const std::string& loading) {
  return build_model(parse_case(patch_case(body, loading),
                                std::string(PERILINK_STUDY_DIR) + "/../../../meshes/patch.toml"));
}

Gradient patch_stress(const Model& model, const Gradient& gradient) {
  const HookeConstants& hooke = model.hooke.front();
  const std::size_t dim = gradient.size();
  double trace = 0.0;
  for (std::size_t a = 0; a < dim; ++a) trace += gradient[a][a];
  Gradient stress(dim, std::vector<double>(dim));
  for (std::size_t a = 0; a < dim; ++a) {
    for (std::size_t b = 0; b < dim; ++b) {
      stress[a][b] =
          hooke.mu * (gradient[a][b] + gradient[b][a]) + (a == b ? hooke.lambda * trace : 0.0);
    }
  }
  return stress;
}

Loads surface_loads(const Model& model, const Gradient& stress) {
  const Network& network = model.network;
  Loads loads{std::vector<double>(
      static_cast<std::size_t>(network.particles.size()) * network.width(), 0.0)};
  std::vector<Index> all(static_cast<std::size_t>(model.facets.size()));
  std::iota(all.begin(), all.end(), Index{0});
  std::erase_if(all, [&](Index facet) { return !model.facets.on_surface(facet); });
  add_surface_load(
      network.particles, model.facets, all,
      [&](std::span<const double>, const Vector3& normal) {
        Vector3 traction{};
        for (std::size_t a = 0; a < stress.size(); ++a) {
          for (std::size_t b = 0; b < stress.size(); ++b) traction[a] += stress[a][b] * normal[b];
        }
        return traction;
      },
      loads);
  return loads;
}

PatchResidual patch_residual(const Model& model) {
  const Network& network = model.network;
  const Particles& particles = network.particles;
  const int dim = network.dim(), width = network.width();
  const std::vector<double> intact(static_cast<std::size_t>(network.num_elements()), 1.0);
  std::vector<double> force(static_cast<std::size_t>(particles.size()), 0.0);
  PatchResidual result;
  double pull = 0.0;
  for (const Gradient& strain : unit_strains(dim)) {
    const Loads loads = surface_loads(model, patch_stress(model, strain));
    std::vector<double> rest =
        internal_force(network, intact, uniform_motion(network, strain)).forces;
    for (std::size_t k = 0; k < rest.size(); ++k) rest[k] -= loads.forces[k];
    for (Index i = 0; i < particles.size(); ++i) {
      pull = std::max(pull, norm(loads.forces.data() + i * width, dim));
      force[i] = std::max(force[i], norm(rest.data() + i * width, dim));
      result.moment = std::max(result.moment, norm(rest.data() + i * width + dim, width - dim));
    }
  }
  for (double& f : force) f /= pull;
  const auto worst =
      static_cast<Index>(std::max_element(force.begin(), force.end()) - force.begin());
  result.force = force[worst];
  std::copy_n(particles.position(worst).begin(), dim, result.at.begin());
  result.particles = static_cast<Index>(
      std::count_if(force.begin(), force.end(), [](double f) { return f > patch_acceptance; }));
  result.moment /= pull * model.lattice.spacing;
  return result;
}

double traction_error(const Model& model) {
  const Network& network = model.network;
  std::vector<std::uint8_t> held(
      static_cast<std::size_t>(network.particles.size()) * network.width(), 0);
  hold_idle_rotations(network, held);
  for (const Fragment& fragment : find_fragments(network, held)) {
    pin_rigid_modes(network, fragment, held);
  }
  const Unknowns unknowns =
      number_unknowns(network.width(), held, std::vector<double>(held.size(), 0.0));
  const Loads loads = surface_loads(model, patch_stress(model, patch_gradient(network.dim())));
  const ElasticResult elastic = run_elastic_analysis({network, unknowns, loads, {}});
  Eigen::VectorXd difference = difference_from_gradient(network, elastic.displacement);
  remove_rigid_motion(network.particles, difference);
  return difference.lpNorm<Eigen::Infinity>() / largest_displacement(network);
}

double displacement_error(const Model& model) {
  const ElasticResult elastic = run_elastic_analysis(model);
  return difference_from_gradient(model.network, elastic.displacement).lpNorm<Eigen::Infinity>() /
         largest_displacement(model.network);
}

bool meets_acceptance(const PatchResult& result) {
  return std::max({result.residual.force, result.residual.moment, result.traction_error,
                   result.displacement_error}) < patch_acceptance;
}

PatchResult run_patch(const PatchBody& body) {
  const Model model = patch_model(body);
  PatchResult result;
  result.body = body;
  result.particles = model.network.particles.size();
  result.bonds = model.network.num_elements();
  result.before = model.network.report.calibration->residual_before;
  result.residual = patch_residual(model);
  result.traction_error = traction_error(model);
  result.displacement_error = displacement_error(model);
  return result;
}

}  // namespace perilink::verification
