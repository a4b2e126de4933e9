// Finite elements that carry particles: patch tests of bodies of elements and particles.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <string>

#include "app/model/from_case/configure.hpp"
#include "app/run/quasistatic.hpp"
#include "support/simplex_meshes.hpp"
#include "support/temporary_directory.hpp"

namespace perilink {
namespace {

struct Patch {
  const char* name;
  std::string body;
  bool space = false;
  std::string elements;
};

void PrintTo(const Patch& patch, std::ostream* out) { *out << patch.name; }

/// The surface of a body is driven by a uniform strain.
std::string patch_end(const std::string& body, int dim, const std::string& elements) {
  std::string text = "[[materials]]\nregion = \"all\"\nyoungs_modulus = 7.0\nfracture_energy = 1\n";
  if (body.find("micropolar") != std::string::npos) text += "poissons_ratio = 0.2\n";
  text += "[[displacements]]\nregion = \"surface\"\nx = \"0.3 * x + 0.1 * y\"\n";
  text += "y = \"0.1 * x - 0.2 * y\"\n";
  if (dim == 3) text += "z = \"0.05 * z\"\n";
  return text + "[analysis]\ntype = \"elastic\"\n[elements]\n" + elements;
}

/// A lattice, all or a part of it in elements.
std::string patch_case(const Patch& patch) {
  const std::string z = patch.space ? "z = [0, 6]\n" : "";
  std::string text = "[body]\n" + patch.body;
  text += "[[regions]]\nname = \"all\"\nx = [0, 12]\ny = [0, 8]\n" + z;
  text += "[[regions]]\nname = \"part\"\nx = [0, 6]\ny = [0, 8]\n" + z;
  return text + patch_end(patch.body, patch.space ? 3 : 2, patch.elements);
}

/// Elements reproduce every linear motion, and calibrated bonds balance every uniform strain, so
/// the two do together, wherever elements end. 1e-10: the bonds balance to 1e-10.
/// \param size  extent of the body, which displacements are a part of [length]
void expect_exact_patch(const CaseFile& input, double size) {
  const Model model = build_model(input);
  ASSERT_TRUE(model.carried);
  ASSERT_GT(std::count(model.carried->whole.begin(), model.carried->whole.end(), 1), 0);
  EXPECT_LT(model.unknowns.count, model.carried->free.count);
  const ElasticAnswer answer = solve_elastic(model, 1);
  const Particles& particles = model.network.particles;
  const int width = model.network.width();
  double error = 0.0;
  for (Index i = 0; i < particles.size(); ++i) {
    const auto x = particles.position(i);
    const double* u = answer.solution.displacement.data() + static_cast<std::size_t>(i) * width;
    error = std::max(error, std::abs(u[0] - (0.3 * x[0] + 0.1 * x[1])));
    error = std::max(error, std::abs(u[1] - (0.1 * x[0] - 0.2 * x[1])));
    if (particles.dim == 3) error = std::max(error, std::abs(u[2] - 0.05 * x[2]));
  }
  EXPECT_LT(error, 1e-10 * size);
}

class CarrierPatches : public testing::TestWithParam<Patch> {};

TEST_P(CarrierPatches, UniformStrainIsExact) {
  expect_exact_patch(parse_case(patch_case(GetParam()), "patch.toml"), 12.0);
}

const std::string ratio3 = "horizon_ratio = 3\nspacing = 0.5\n";

INSTANTIATE_TEST_SUITE_P(
    Bodies, CarrierPatches,
    testing::Values(
        Patch{"rectangular", "pattern = \"rectangular\"\n" + ratio3, false, "spacings = 4\n"},
        Patch{"part", "pattern = \"rectangular\"\n" + ratio3, false,
              "spacings = 4\nregions = [\"part\"]\n"},
        Patch{"particles", "pattern = \"rectangular\"\n" + ratio3, false,
              "size = 1.7\nparticles = [\"part\"]\n"},
        Patch{"hexagonal", "pattern = \"hexagonal\"\n" + ratio3, false, "spacings = 3\n"},
        Patch{"hexagonal of two", "pattern = \"hexagonal\"\n" + ratio3, false,
              "spacings = 2\norder = 1\n"},
        Patch{"micropolar", "pattern = \"rectangular\"\nmodel = \"micropolar\"\n" + ratio3, false,
              "spacings = 4\n"},
        Patch{"plane strain", "problem = \"plane_strain\"\npattern = \"rectangular\"\n" + ratio3,
              false, "spacings = 3\n"},
        Patch{"cubic",
              "problem = \"three_dimensional\"\npattern = \"cubic\"\nhorizon_ratio = 2\n"
              "spacing = 0.75\n",
              true, "spacings = 2\n"},
        Patch{"cubic micropolar",
              "problem = \"three_dimensional\"\nmodel = \"micropolar\"\nhorizon_ratio = 2\n"
              "spacing = 1\n",
              true, "spacings = 2\norder = 1\n"}),
    [](const auto& patch) {
      std::string name = patch.param.name;
      std::replace(name.begin(), name.end(), ' ', '_');
      return name;
    });

/// A mesh of particles in elements of a coarser one, which knows nothing of the first: holes and
/// round sides cut its cells.
struct MeshPatch {
  const char* name;
  std::string mesh;  ///< in the folder of meshes; empty: a box
  int dim;
  std::string more;  ///< in [body]
  std::string elements;
};

void PrintTo(const MeshPatch& patch, std::ostream* out) { *out << patch.name; }

class MeshCarrierPatches : public testing::TestWithParam<MeshPatch> {};

TEST_P(MeshCarrierPatches, UniformStrainIsExact) {
  const MeshPatch& patch = GetParam();
  const test::TemporaryDirectory directory;
  const auto write_box = [&](const char* name, int count) {
    std::ofstream(directory / name)
        << test::gmsh_text(test::box_mesh(patch.dim, count), {6, 6, 6}, {-3, -3, -3});
  };
  write_box("coarse.msh", 3);
  if (patch.mesh.empty()) write_box("fine.msh", 8);
  const std::string mesh =
      patch.mesh.empty() ? "fine.msh" : std::string(PERILINK_SOURCE_DIR) + "/meshes/" + patch.mesh;
  std::string text = "[body]\nmesh = \"" + mesh + "\"\nhorizon_ratio = 3\n" + patch.more;
  if (patch.dim == 3) text += "problem = \"three_dimensional\"\n";
  text += "[[regions]]\nname = \"all\"\nx = [-9, 9]\ny = [-9, 9]\n";
  if (patch.dim == 3) text += "z = [-9, 9]\n";
  text += patch_end(patch.more, patch.dim, "mesh = \"coarse.msh\"\n" + patch.elements);
  expect_exact_patch(parse_case(text, (directory / "patch.toml").string()), 6.0);
}

INSTANTIATE_TEST_SUITE_P(
    Bodies, MeshCarrierPatches,
    testing::Values(MeshPatch{"plate_with_hole", "full_plate_with_hole.msh", 2, "", ""},
                    MeshPatch{"linear", "full_plate_with_hole.msh", 2, "", "order = 1\n"},
                    MeshPatch{"micropolar", "full_plate_with_hole.msh", 2,
                              "model = \"micropolar\"\n", ""},
                    MeshPatch{"box", "", 2, "", "order = 1\n"},
                    MeshPatch{"space", "", 3, "", "order = 1\n"}),
    [](const auto& patch) { return std::string(patch.param.name); });

}  // namespace
}  // namespace perilink
