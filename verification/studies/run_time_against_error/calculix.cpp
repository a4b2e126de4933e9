#include "calculix.hpp"

#include <fmt/format.h>
#include <fmt/os.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <map>
#include <memory>
#include <sstream>
#include <stdexcept>

#include "base/timer.hpp"

namespace perilink::verification {
namespace {

namespace fs = std::filesystem;

/// Numbers of an input file have at most twenty characters.
std::string number(double value) { return fmt::format("{:.12e}", value); }

void write_nodes(fmt::ostream& file, const Particles& particles) {
  file.print("*NODE, NSET=ALL\n");
  for (Index i = 0; i < particles.size(); ++i) {
    const auto x = particles.position(i);
    file.print("{},{},{},{}\n", i + 1, number(x[0]), number(x[1]),
               number(x.size() == 3 ? x[2] : 0.0));
  }
}

void write_cells(fmt::ostream& file, const CalculixMesh& mesh) {
  file.print("*ELEMENT, TYPE={}, ELSET=SOLID\n", mesh.type);
  for (std::size_t at = 0; at < mesh.particles.size(); at += mesh.width) {
    file.print("{}", at / mesh.width + 1);
    for (std::size_t v = 0; v < mesh.width; ++v) file.print(",{}", mesh.particles[at + v] + 1);
    file.print("\n");
  }
}

void write_step(fmt::ostream& file, const Model& model, double force_factor) {
  const int dim = model.network.dim();
  file.print("*STEP\n*STATIC\n*BOUNDARY\n");
  for (std::size_t slot = 0; slot < model.unknowns.number.size(); ++slot) {
    if (model.unknowns.number[slot] != no_index) continue;
    file.print("{},{axis},{axis},{}\n", slot / dim + 1, number(model.unknowns.prescribed[slot]),
               fmt::arg("axis", slot % dim + 1));
  }
  file.print("*CLOAD\n");
  for (std::size_t slot = 0; slot < model.loads.forces.size(); ++slot) {
    if (model.loads.forces[slot] == 0.0 || model.unknowns.number[slot] == no_index) continue;
    file.print("{},{},{}\n", slot / dim + 1, slot % dim + 1,
               number(force_factor * model.loads.forces[slot]));
  }
  file.print("*NODE PRINT, NSET=ALL\nU\n*END STEP\n");
}

/// Runs `ccx`, whose messages tell when a phase begins.
MemberSeconds run(const fs::path& directory) {
  const std::string command =
      fmt::format("cd '{}' && OMP_NUM_THREADS=1 stdbuf -oL ccx -i body 2>&1", directory.string());
  Timer timer;
  double structure = 0.0, factoring = 0.0, solved = 0.0;
  std::unique_ptr<FILE, int (*)(FILE*)> pipe(popen(command.c_str(), "r"), pclose);
  if (!pipe) throw std::runtime_error("CalculiX cannot be started");
  std::array<char, 512> buffer{};
  std::string all;
  while (std::fgets(buffer.data(), buffer.size(), pipe.get()) != nullptr) {
    const std::string line = buffer.data();
    all += line;
    const double now = timer.seconds();
    if (line.find("Determining the structure") != std::string::npos) structure = now;
    if (line.find("Factoring the system") != std::string::npos) factoring = now;
    if (factoring > 0.0 && solved == 0.0 && line.find("stress calculation") != std::string::npos) {
      solved = now;
    }
  }
  if (solved == 0.0) throw std::runtime_error("CalculiX failed:\n" + all);
  MemberSeconds seconds;
  seconds.set_up = structure;
  seconds.assembly = factoring - structure;
  seconds.factorization = solved - factoring;
  seconds.analysis = solved - structure;
  return seconds;
}

std::vector<double> read_displacement(const fs::path& path, const Particles& particles) {
  std::vector<double> displacement(static_cast<std::size_t>(particles.size()) * particles.dim, 0.0);
  std::ifstream file(path);
  Index found = 0;
  for (std::string line; std::getline(file, line);) {
    std::istringstream fields(line);
    Index node = 0;
    std::array<double, 3> u{};
    if (!(fields >> node >> u[0] >> u[1] >> u[2]) || node < 1 || node > particles.size()) continue;
    for (int a = 0; a < particles.dim; ++a) {
      displacement[static_cast<std::size_t>(node - 1) * particles.dim + a] = u[a];
    }
    ++found;
  }
  if (found != particles.size()) {
    throw std::runtime_error(
        fmt::format("CalculiX gave {} displacements of {}", found, particles.size()));
  }
  return displacement;
}

}  // namespace

CalculixMesh simplices_for_calculix(const Model& model) {
  const Simplices& cells = model.elements.value().cells;
  return {cells.dim == 2 ? "CPS3" : "C3D4", static_cast<std::size_t>(cells.dim) + 1,
          cells.vertices};
}

CalculixMesh boxes_for_calculix(const Model& model) {
  const Particles& particles = model.network.particles;
  const int dim = particles.dim;
  std::map<std::array<long, 3>, Index> at;
  for (Index i = 0; i < particles.size(); ++i) {
    std::array<long, 3> place{};
    for (int a = 0; a < dim; ++a) {
      place[a] = std::lround((particles.position(i)[a] - particles.position(0)[a]) /
                             model.lattice.step[a]);
    }
    at[place] = i;
  }
  CalculixMesh mesh{dim == 2 ? "CPS4" : "C3D8", dim == 2 ? 4u : 8u, {}};
  constexpr std::array<std::array<long, 3>, 8> corners = {
      {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}}};
  for (const auto& [place, particle] : at) {
    std::vector<Index> cell;
    for (std::size_t c = 0; c < mesh.width; ++c) {
      const auto found =
          at.find({place[0] + corners[c][0], place[1] + corners[c][1], place[2] + corners[c][2]});
      if (found != at.end()) cell.push_back(found->second);
    }
    if (cell.size() == mesh.width) {
      mesh.particles.insert(mesh.particles.end(), cell.begin(), cell.end());
    }
  }
  return mesh;
}

bool has_calculix() { return std::system("ccx -v > /dev/null 2>&1; test $? -ne 127") == 0; }

CalculixRun run_calculix(const fs::path& directory, const Model& model, const CalculixMesh& mesh,
                         double youngs_modulus, double poissons_ratio, double thickness) {
  fs::create_directories(directory);
  const bool plane = model.network.dim() == 2;
  const double thin = plane ? 0.01 * model.lattice.spacing : 1.0;
  {
    fmt::ostream file = fmt::output_file((directory / "body.inp").string());
    write_nodes(file, model.network.particles);
    write_cells(file, mesh);
    file.print("*MATERIAL, NAME=M\n*ELASTIC\n{},{}\n*SOLID SECTION, ELSET=SOLID, MATERIAL=M\n",
               number(youngs_modulus), number(poissons_ratio));
    if (plane) file.print("{}\n", number(thin));
    write_step(file, model, plane ? thin / thickness : 1.0);
  }
  CalculixRun result;
  result.seconds = run(directory);
  result.displacement = read_displacement(directory / "body.dat", model.network.particles);
  return result;
}

}  // namespace perilink::verification
