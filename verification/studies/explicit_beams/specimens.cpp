#include "specimens.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "analysis/quasistatic/elastic_analysis.hpp"
#include "io/case/case_file.hpp"
#include "material/micromodulus.hpp"

namespace perilink::verification {
namespace {

constexpr int clamped_layers = 6;
constexpr double fibre_horizon = 5.4;  ///< in cells
constexpr double bond_horizon = 3.0;

struct Interval {
  double lower, upper;
};

std::string region(const std::string& name, Interval x, Interval y, Interval z) {
  return fmt::format("[[regions]]\nname = \"{}\"\nx = [{}, {}]\ny = [{}, {}]\nz = [{}, {}]\n", name,
                     x.lower, x.upper, y.lower, y.upper, z.lower, z.upper);
}

std::string support(const std::string& name) {
  return fmt::format("[[supports]]\nregion = \"{}\"\nfix = [\"x\", \"y\", \"z\"]\n", name);
}

/// Regions, supports and loads of a case whose particles lie within the box, with a built-in part
/// of the given depth.
std::string case_text(Structure structure, const Sizes& sizes, Interval x, Interval y, Interval z,
                      double built_in, const std::string& joined_by) {
  const bool plate = structure == Structure::plate;
  std::string text = fmt::format("[body]\nproblem = \"three_dimensional\"\nspacing = {}\n{}",
                                 sizes.cell, joined_by);
  text += region("body of it", x, y, z);
  text += region("left", {x.lower, x.lower + built_in}, y, z);
  text += region("right", {x.upper - built_in, x.upper}, y, z);
  text += region("front", x, {y.lower, y.lower + built_in}, z);
  text += fmt::format(
      "[[materials]]\nregion = \"body of it\"\nyoungs_modulus = {}\nfracture_energy = "
      "\"infinite\"\n",
      youngs_modulus);
  text += support("left");
  if (structure != Structure::cantilever) text += support("right");
  if (plate) text += support("front");
  text += fmt::format("[[loads]]\nregion = \"body of it\"\nbody_force = [0, {}, {}]\n",
                      plate ? 0.0 : -body_force, plate ? -body_force : 0.0);
  return text + "[analysis]\ntype = \"elastic\"\n";
}

/// Equal bonds between equal particles.
void make_fibres(const Sizes& sizes, Model& model) {
  const double volume = std::pow(sizes.cell, 3);
  Network& network = model.network;
  std::fill(network.particles.volumes.begin(), network.particles.volumes.end(), volume);
  const double c =
      continuum_micromodulus(Problem::three_dimensional, youngs_modulus, model.horizon, 1.0);
  for (Index e = 0; e < network.num_elements(); ++e) {
    network.stiffness[e] = c * volume * volume / network.bonds.lengths[e];
  }
  for (std::size_t slot = 0; slot < model.loads.forces.size(); ++slot) {
    double& force = model.loads.forces[slot];
    const bool loaded = force != 0.0 && model.unknowns.number[slot] != no_index;
    force = loaded ? std::copysign(body_force * volume, force) : 0.0;
  }
}

int load_axis(Structure structure) { return structure == Structure::plate ? 2 : 1; }

/// Mean of the deflections of the particles in a slice, weighted with their volumes.
template <class IsIn>
double mean_deflection(const Specimen& specimen, std::span<const double> displacement, IsIn is_in) {
  const Particles& particles = specimen.model.network.particles;
  double sum = 0.0, volume = 0.0;
  for (Index i = 0; i < particles.size(); ++i) {
    if (!is_in(particles.position(i))) continue;
    sum -= particles.volumes[i] * displacement[3 * i + load_axis(specimen.structure)];
    volume += particles.volumes[i];
  }
  return sum / volume;
}

}  // namespace

std::string to_string(Structure structure) {
  switch (structure) {
    case Structure::cantilever: return "cantilever";
    case Structure::clamped: return "clamped beam";
    case Structure::plate: break;
  }
  return "plate";
}

Sizes sizes_of(Structure structure) {
  if (structure == Structure::plate) return {30, 24, 6};
  return {80, 10, 6};
}

Specimen make_specimen(Structure structure, const Sizes& sizes, const std::string& joined) {
  Specimen specimen;
  specimen.structure = structure;
  specimen.sizes = sizes;
  specimen.joined = joined;
  specimen.in_cells = joined == "fibres";
  const double h = sizes.cell, tiny = 1e-3 * h;
  Interval x{0.0, sizes.x()}, y{0.0, sizes.y()}, z{0.0, sizes.z()};
  double built_in = tiny;
  std::string joined_by =
      fmt::format("surface = \"{}\"\nhorizon = {}\n", joined, (bond_horizon + 1e-6) * h);
  if (joined == "linear elements") joined_by = "method = \"linear_elements\"\n";
  if (specimen.in_cells) {
    const double more = clamped_layers * h;
    x = {-more + 0.5 * h, sizes.x() - 0.5 * h};
    if (structure != Structure::cantilever) x.upper += more;
    y = {0.5 * h - (structure == Structure::plate ? more : 0.0), sizes.y() - 0.5 * h};
    z = {0.5 * h, sizes.z() - 0.5 * h};
    built_in = more - 0.5 * h;
    joined_by = fmt::format("surface = \"none\"\nhorizon = {}\n", fibre_horizon * h);
  }
  specimen.model =
      build_model(parse_case(case_text(structure, sizes, x, y, z, built_in, joined_by), joined));
  if (specimen.in_cells) make_fibres(sizes, specimen.model);
  return specimen;
}

double axial_modulus(const Specimen& specimen) {
  const Model& model = specimen.model;
  const double end = specimen.sizes.x(), pull = 1e-3;
  const Particles& particles = model.network.particles;
  // The last layer of the cantilever is moved along x.
  std::vector<std::uint8_t> held;
  std::vector<double> prescribed;
  for (Index i = 0; i < particles.size(); ++i) {
    const double x = particles.position(i)[0];
    const bool last = x > end - specimen.sizes.cell;
    for (int a = 0; a < 3; ++a) {
      held.push_back(model.unknowns.at(i, a) == no_index || (last && a == 0));
      prescribed.push_back(last && a == 0 ? pull : 0.0);
    }
  }
  const Unknowns unknowns = number_unknowns(3, held, prescribed);
  const Loads none{std::vector<double>(held.size(), 0.0)};
  const ElasticResult result = run_elastic_analysis({model.network, unknowns, none, {}});
  const double length = end - 0.5 * specimen.sizes.cell;
  const double area = specimen.sizes.y() * specimen.sizes.z();
  return 2.0 * result.strain_energy / (pull * pull) * length / area;
}

double deflection(const Specimen& specimen, std::span<const double> displacement) {
  const Sizes& sizes = specimen.sizes;
  const double h = sizes.cell, half = 0.51 * h;
  const double middle = 0.5 * sizes.x();
  if (specimen.structure != Structure::plate) {
    const double x0 = specimen.structure == Structure::clamped ? middle : sizes.x();
    return mean_deflection(specimen, displacement,
                           [&](auto x) { return std::abs(x[0] - x0) < half; });
  }
  const auto near_edge = [&](double distance) {
    return mean_deflection(specimen, displacement, [&](auto x) {
      return std::abs(x[0] - middle) < half && std::abs(sizes.y() - distance - x[1]) < 0.1 * h;
    });
  };
  if (!specimen.in_cells) return near_edge(0.0);
  return 1.5 * near_edge(0.5 * h) - 0.5 * near_edge(1.5 * h);
}

Shape shape(const Specimen& specimen, std::span<const double> displacement) {
  const Particles& particles = specimen.model.network.particles;
  std::map<long, double> places;
  for (Index i = 0; i < particles.size(); ++i) {
    const double x = particles.position(i)[0];
    if (x > 0.0 && x < specimen.sizes.x() * (1.0 + 1e-9)) {
      places.emplace(std::lround(4.0 * x / specimen.sizes.cell), x);
    }
  }
  Shape result;
  for (const auto& [key, place] : places) {
    result.x.push_back(place);
    result.deflection.push_back(mean_deflection(specimen, displacement, [&](auto x) {
      return std::abs(x[0] - place) < 0.1 * specimen.sizes.cell;
    }));
  }
  return result;
}

double bernoulli(Structure structure, const Sizes& sizes, double x) {
  const double load = body_force * sizes.y() * sizes.z(), length = sizes.x();
  const double stiffness = youngs_modulus * sizes.z() * std::pow(sizes.y(), 3) / 12.0;
  if (structure == Structure::clamped) {
    return load * std::pow(x * (length - x), 2) / (24.0 * stiffness);
  }
  return load * x * x * (6.0 * length * length - 4.0 * length * x + x * x) / (24.0 * stiffness);
}

double timoshenko(Structure structure, const Sizes& sizes, double x) {
  const double load = body_force * sizes.y() * sizes.z(), length = sizes.x();
  const double nu = poissons_ratio, share = 10.0 * (1.0 + nu) / (12.0 + 11.0 * nu);
  const double stiffness = share * youngs_modulus / (2.0 * (1.0 + nu)) * sizes.y() * sizes.z();
  const double shear = structure == Structure::clamped ? 0.5 * load * x * (length - x) / stiffness
                                                       : load * x * (length - 0.5 * x) / stiffness;
  return bernoulli(structure, sizes, x) + shear;
}

}  // namespace perilink::verification
