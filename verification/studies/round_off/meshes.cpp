#include "meshes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <fstream>
#include <limits>
#include <map>
#include <numeric>
#include <random>
#include <span>

#include "analysis/quasistatic/damage_analysis.hpp"
#include "io/case/case_file.hpp"
#include "io/mesh/mesh_file.hpp"
#include "model/from_case/analysis_options.hpp"
#include "model/from_case/configure.hpp"

namespace perilink::verification {
namespace {

constexpr double millimetres_to_metres = 1e-3;

struct Extent {
  Vector3 lower{}, upper{};
};

Extent extent_of(const Mesh& mesh) {
  Extent extent;
  for (int a = 0; a < mesh.dim; ++a) {
    extent.lower[a] = std::numeric_limits<double>::infinity();
    extent.upper[a] = -extent.lower[a];
  }
  for (std::size_t k = 0; k < mesh.positions.size(); ++k) {
    const std::size_t a = k % static_cast<std::size_t>(mesh.dim);
    extent.lower[a] = std::min(extent.lower[a], mesh.positions[k]);
    extent.upper[a] = std::max(extent.upper[a], mesh.positions[k]);
  }
  return extent;
}

std::string bytes_of(const auto& value) {
  return {reinterpret_cast<const char*>(&value), sizeof(value)};
}

/// As gmsh writes it, without groups.
std::string gmsh_bytes(const Mesh& mesh, bool binary) {
  const std::size_t points = static_cast<std::size_t>(mesh.num_points());
  const std::size_t cells = static_cast<std::size_t>(mesh.num_cells());
  const std::size_t width = static_cast<std::size_t>(mesh.dim) + 1;
  std::string text = fmt::format("$MeshFormat\n4.1 {} 8\n", binary ? 1 : 0);
  if (binary) text += bytes_of(1) + "\n";
  text += "$EndMeshFormat\n$Nodes\n";
  const auto put = [&](auto value, const char* end) {
    text += binary ? bytes_of(value) : fmt::format("{}{}", value, end);
  };
  for (const std::size_t n : {std::size_t{1}, points, std::size_t{1}}) put(n, " ");
  put(points, "\n");
  for (const int n : {mesh.dim, 1, 0}) put(n, " ");
  put(points, "\n");
  for (std::size_t i = 1; i <= points; ++i) put(i, "\n");
  for (std::size_t i = 0; i < points; ++i) {
    for (int a = 0; a < 3; ++a) put(a < mesh.dim ? mesh.positions[i * mesh.dim + a] : 0.0, " ");
    if (!binary) text += "\n";
  }
  text += "\n$EndNodes\n$Elements\n";
  for (const std::size_t n : {std::size_t{1}, cells, std::size_t{1}}) put(n, " ");
  put(cells, "\n");
  for (const int n : {mesh.dim, 1, mesh.dim == 2 ? 2 : 4}) put(n, " ");
  put(cells, "\n");
  for (std::size_t e = 0; e < cells; ++e) {
    put(e + 1, " ");
    for (std::size_t k = 0; k < width; ++k) {
      put(static_cast<std::size_t>(mesh.cells[e * width + k]) + 1, " ");
    }
    if (!binary) text += "\n";
  }
  return text + "\n$EndElements\n";
}

std::string range(const Vector3& lower, const Vector3& upper, int dim) {
  std::string text;
  for (int a = 0; a < dim; ++a) {
    text += fmt::format("{} = [{}, {}]\n", "xyz"[a], lower[a], upper[a]);
  }
  return text;
}

/// \param unit  length unit over that of the mesh
std::string case_text(const MeshBody& body, const Mesh& mesh, double unit, int broken) {
  const int dim = mesh.dim, last = dim - 1;
  const Extent extent = extent_of(mesh);
  const double size = extent.upper[last] - extent.lower[last], margin = 1e-3 * size;
  Vector3 lower = extent.lower, upper = extent.upper;
  for (int a = 0; a < dim; ++a) {
    lower[a] -= margin;
    upper[a] += margin;
  }
  std::string text = fmt::format(
      "[body]\nmesh = \"body.msh\"\nhorizon_ratio = {}\n{}{}", body.horizon_ratio,
      body.poissons_ratio > 0.0 ? "model = \"micropolar\"\n" : "",
      dim == 2 ? fmt::format("thickness = {}\n", unit) : "problem = \"three_dimensional\"\n");
  const auto region = [&](const std::string& name, const Vector3& from, const Vector3& to) {
    text += fmt::format("[[regions]]\nname = \"{}\"\n{}", name, range(from, to, dim));
  };
  Vector3 middle = lower, below = upper, above = lower;
  middle[0] = 0.5 * (lower[0] + upper[0]);
  below[last] = extent.lower[last] + 0.12 * size;
  above[last] = extent.upper[last] - 0.12 * size;
  region("all", lower, upper);
  region("right", middle, upper);
  region("below", lower, below);
  region("above", above, upper);
  for (const char* name : {"all", "right"}) {
    const double modulus = 30e3 * (name == std::string("all") ? 1.0 : body.stiffer);
    if (name == std::string("right") && body.stiffer == 1.0) continue;
    text +=
        fmt::format("[[materials]]\nregion = \"{}\"\nyoungs_modulus = {}\nfracture_energy = {}\n",
                    name, modulus / unit / unit, 0.1 / unit);
    if (body.poissons_ratio > 0.0)
      text += fmt::format("poissons_ratio = {}\n", body.poissons_ratio);
    if (body.strength > 0.0) {
      text += fmt::format("tensile_strength = {}\n", body.strength / unit / unit);
    }
  }
  const char axis = "xyz"[last];
  text += "[[supports]]\nregion = \"below\"\nfix = [\"x\", \"y\"";
  text += dim == 3 ? ", \"z\"]\n" : "]\n";
  text += fmt::format("[[displacements]]\nregion = \"above\"\n{} = {}\n", axis, 1e-3 * size);
  text += fmt::format("[stop]\nload_fraction = 0.5\nbroken_bonds = {}\n", std::max(broken, 1));
  return text;
}

class Quiet : public StepObserver {
  void on_step(const StepRecord&, StateSource&) override {}
};

}  // namespace

Mesh read_body(const std::string& name, int dim) {
  const Mesh mesh = load_mesh(PERILINK_SOURCE_DIR "/meshes/" + name + ".msh", dim);
  Mesh result;
  result.dim = dim;
  std::vector<Index> number(static_cast<std::size_t>(mesh.num_points()), no_index);
  for (const Index point : mesh.cells) number[point] = 0;
  for (Index i = 0, count = 0; i < mesh.num_points(); ++i) {
    if (number[i] == no_index) continue;
    number[i] = count++;
    const double* x = mesh.positions.data() + static_cast<std::size_t>(i) * dim;
    result.positions.insert(result.positions.end(), x, x + dim);
  }
  for (const Index point : mesh.cells) result.cells.push_back(number[point]);
  return result;
}

Mesh changed(const Mesh& mesh, Change change, std::vector<Index>& number) {
  Mesh result = mesh;
  number.resize(static_cast<std::size_t>(mesh.num_points()));
  std::iota(number.begin(), number.end(), 0);
  std::mt19937 random(11);
  const Extent extent = extent_of(mesh);
  const std::size_t dim = static_cast<std::size_t>(mesh.dim), width = dim + 1;
  if (change == Change::scaled) {
    for (double& x : result.positions) x *= millimetres_to_metres;
  } else if (change == Change::moved) {
    const double far = 1000.0 * (extent.upper[0] - extent.lower[0]);
    for (std::size_t k = 0; k < result.positions.size(); ++k) {
      result.positions[k] += k % dim == 0 ? far : -0.7 * far;
    }
  } else if (change == Change::noisy) {
    for (double& x : result.positions) {
      x = std::nextafter(x, random() % 2 ? 1e300 : -1e300);
    }
  } else if (change == Change::renumbered) {
    std::shuffle(number.begin(), number.end(), random);
    for (std::size_t i = 0; i < number.size(); ++i) {
      for (std::size_t a = 0; a < dim; ++a) {
        result.positions[number[i] * dim + a] = mesh.positions[i * dim + a];
      }
    }
    std::vector<std::size_t> order(static_cast<std::size_t>(mesh.num_cells()));
    std::iota(order.begin(), order.end(), 0);
    std::shuffle(order.begin(), order.end(), random);
    for (std::size_t e = 0; e < order.size(); ++e) {
      for (std::size_t k = 0; k < width; ++k) {
        const std::size_t from = (k + e) % width;  // corners turned round as well
        result.cells[e * width + k] = number[mesh.cells[order[e] * width + from]];
      }
    }
  }
  return result;
}

ChangedBody run_changed(const MeshBody& body, Change change, int broken,
                        const std::filesystem::path& directory) {
  std::vector<Index> number;
  const Mesh mesh = changed(body.mesh, change, number);
  std::filesystem::create_directories(directory);
  std::ofstream(directory / "body.msh", std::ios::binary)
      << gmsh_bytes(mesh, change == Change::binary);
  const double unit = change == Change::scaled ? millimetres_to_metres : 1.0;
  const CaseFile input =
      parse_case(case_text(body, mesh, unit, broken), (directory / "body.toml").string());
  const std::clock_t start = std::clock();
  ChangedBody result{build_model(input)};
  result.seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
  if (broken == 0) return result;
  Quiet observer;
  result.peak = run_damage_analysis(result.model, damage_options(input, 1), observer).peak_load;
  return result;
}

double stiffness_difference(const MeshBody& body, const Model& plain, const Model& other,
                            Change change) {
  std::vector<Index> number;
  changed(body.mesh, change, number);
  const double unit = change == Change::scaled ? millimetres_to_metres : 1.0;
  const auto stiffnesses = [](const Model& model, std::span<const Index> numbers, double factor) {
    std::map<std::pair<Index, Index>, double> result;
    for (Index b = 0; b < model.network.bonds.size(); ++b) {
      const auto ends = std::minmax(numbers[model.network.bonds.first[b]],
                                    numbers[model.network.bonds.second[b]]);
      result[ends] = factor * model.network.stiffness[b];
    }
    return result;
  };
  std::vector<Index> back(number.size()), same(number.size());
  std::iota(same.begin(), same.end(), 0);
  for (std::size_t i = 0; i < number.size(); ++i) back[number[i]] = static_cast<Index>(i);
  const auto here = stiffnesses(plain, same, 1.0), there = stiffnesses(other, back, unit);
  double largest = 0.0, sum = 0.0;
  if (here.size() != there.size()) return std::numeric_limits<double>::infinity();
  for (auto a = here.begin(), b = there.begin(); a != here.end(); ++a, ++b) {
    if (a->first != b->first) return std::numeric_limits<double>::infinity();
    largest = std::max(largest, std::abs(a->second - b->second));
    sum += a->second;
  }
  return largest / (sum / static_cast<double>(here.size()));
}

}  // namespace perilink::verification
