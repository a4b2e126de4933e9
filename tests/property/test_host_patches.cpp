// Host elements that constrain particles: patch tests of bodies of elements and particles.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <string>

#include "app/run/quasistatic.hpp"
#include "model/from_case/configure.hpp"
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

/// Returns tables that prescribe a uniform strain on the surface of a body.
std::string patch_end(const std::string& body, int dim, const std::string& elements) {
  std::string text = "[[materials]]\nregion = \"all\"\nyoungs_modulus = 7.0\nfracture_energy = 1\n";
  if (body.find("micropolar") != std::string::npos) text += "poissons_ratio = 0.2\n";
  text += "[[displacements]]\nregion = \"surface\"\nx = \"0.3 * x + 0.1 * y\"\n";
  text += "y = \"0.1 * x - 0.2 * y\"\n";
  if (dim == 3) text += "z = \"0.05 * z\"\n";
  return text + "[analysis]\ntype = \"elastic\"\n[elements]\n" + elements;
}

/// Returns a case of a lattice with all or some particles in host elements.
std::string patch_case(const Patch& patch) {
  const std::string z = patch.space ? "z = [0, 6]\n" : "";
  std::string text = "[body]\n" + patch.body;
  text += "[[regions]]\nname = \"all\"\nx = [0, 12]\ny = [0, 8]\n" + z;
  text += "[[regions]]\nname = \"part\"\nx = [0, 6]\ny = [0, 8]\n" + z;
  return text + patch_end(patch.body, patch.space ? 3 : 2, patch.elements);
}

/// Expects a linear motion. Elements reproduce every linear motion, and calibrated bonds balance
/// every uniform strain to 1e-10, so both together are exact for any boundary of the elements.
/// \param size  extent of the body, the scale of displacements [length]
/// \param rest  residual of the bonds if the calibration has no exact solution
void expect_linear_motion(const Model& model, double size, double rest = 0.0) {
  const ElasticAnswer answer = solve_elastic(model, {});
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
  EXPECT_LT(error, std::max(1e-10, rest) * size);
}

void expect_exact_patch(const CaseFile& input, double size) {
  const Model model = build_model(input);
  ASSERT_TRUE(model.embedded);
  ASSERT_GT(std::count(model.embedded->whole.begin(), model.embedded->whole.end(), 1), 0);
  EXPECT_LT(model.unknowns.count, model.embedded->free.count);
  expect_linear_motion(model, size);
}

class HostPatches : public testing::TestWithParam<Patch> {};

TEST_P(HostPatches, UniformStrainIsExact) {
  expect_exact_patch(parse_case(patch_case(GetParam()), "patch.toml"), 12.0);
}

const std::string ratio3 = "horizon_ratio = 3\nspacing = 0.5\n";

INSTANTIATE_TEST_SUITE_P(
    Bodies, HostPatches,
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

/// Mesh of particles in elements of a coarser, independent mesh; holes and round sides cut its
/// cells.
struct MeshPatch {
  const char* name;
  std::string mesh;  ///< file in the folder of meshes; empty: a box
  int dim;
  std::string more;  ///< keys of [body]
  std::string elements;
};

void PrintTo(const MeshPatch& patch, std::ostream* out) { *out << patch.name; }

class MeshHostPatches : public testing::TestWithParam<MeshPatch> {};

TEST_P(MeshHostPatches, UniformStrainIsExact) {
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
    Bodies, MeshHostPatches,
    testing::Values(MeshPatch{"plate_with_hole", "full_plate_with_hole.msh", 2, "", ""},
                    MeshPatch{"linear", "full_plate_with_hole.msh", 2, "", "order = 1\n"},
                    MeshPatch{"micropolar", "full_plate_with_hole.msh", 2,
                              "model = \"micropolar\"\n", ""},
                    MeshPatch{"box", "", 2, "", "order = 1\n"},
                    MeshPatch{"space", "", 3, "", "order = 1\n"}),
    [](const auto& patch) { return std::string(patch.param.name); });

/// Bonds in one half of a box, ordinary linear elements in the other, with shared vertices between
/// them.
class TiedPatches : public testing::TestWithParam<MeshPatch> {};

TEST_P(TiedPatches, UniformStrainIsExact) {
  const MeshPatch& patch = GetParam();
  const test::TemporaryDirectory directory;
  std::ofstream(directory / "box.msh") << test::gmsh_text(
      test::box_mesh(patch.dim, patch.dim == 2 ? 12 : 8), {6, 6, 6}, {-3, -3, -3});
  const std::string z = patch.dim == 3 ? "z = [-9, 9]\n" : "";
  std::string text = "[body]\nmesh = \"box.msh\"\nhorizon_ratio = 3\n" + patch.more;
  if (patch.dim == 3) text += "problem = \"three_dimensional\"\n";
  text += "[[regions]]\nname = \"all\"\nx = [-9, 9]\ny = [-9, 9]\n" + z;
  text += "[[regions]]\nname = \"half\"\nx = [0, 9]\ny = [-9, 9]\n" + z;
  text += patch_end(patch.more, patch.dim, "glued = [\"half\"]\n" + patch.elements);
  const Model model = build_model(parse_case(text, (directory / "patch.toml").string()));
  ASSERT_TRUE(model.network.cells);
  EXPECT_GT(model.network.cells->cells.size(), model.cells.size() / 3);
  EXPECT_EQ(model.embedded.has_value(), !patch.elements.empty());
  // In space the equal area fractions of tied facets prevent an exact calibration of bonds at their
  // edges.
  const double rest = model.network.report.calibration->residual_after;
  EXPECT_LT(rest, patch.dim == 2 ? 1e-10 : 1e-2);
  expect_linear_motion(model, 6.0, patch.dim == 2 ? 0.0 : rest);
}

INSTANTIATE_TEST_SUITE_P(
    Bodies, TiedPatches,
    testing::Values(MeshPatch{"plane", "", 2, "", ""}, MeshPatch{"space", "", 3, "", ""},
                    MeshPatch{"micropolar", "", 2, "model = \"micropolar\"\n", ""},
                    MeshPatch{"micropolar_space", "", 3, "model = \"micropolar\"\n", ""},
                    MeshPatch{"plane_strain", "", 2, "problem = \"plane_strain\"\n", ""},
                    MeshPatch{"beside_carriers", "", 2, "", "size = 1.2\norder = 1\n"}),
    [](const auto& patch) { return std::string(patch.param.name); });

class Silent : public StepObserver {
  void on_step(const StepRecord& /*record*/, StateSource& /*source*/) override {}
};

/// Clamps on tied vertices also carry the forces of the finite elements, including those of an
/// earlier stage.
TEST(TiedStages, WorkOfGripsBalances) {
  const test::TemporaryDirectory directory;
  std::ofstream(directory / "box.msh")
      << test::gmsh_text(test::box_mesh(2, 12), {6, 6, 6}, {-3, -3, -3});
  const auto run = [&](const char* tied) {
    const std::string text =
        std::string("[body]\nmesh = \"box.msh\"\nhorizon_ratio = 3\n") +
        "[[regions]]\nname = \"all\"\nx = [-9, 9]\ny = [-9, 9]\n"
        "[[regions]]\nname = \"half\"\nx = [0, 9]\ny = [-9, 9]\n"
        "[[regions]]\nname = \"left\"\nx = [-3, -3]\ny = [-9, 9]\n"
        "[[regions]]\nname = \"right\"\nx = [3, 3]\ny = [-9, 9]\n"
        "[[materials]]\nregion = \"all\"\nyoungs_modulus = 100\nfracture_energy = 1000\n"
        "[[supports]]\nregion = \"left\"\nfix = [\"x\", \"y\"]\n"
        "[[loads]]\nregion = \"all\"\nbody_force = [0.1, -0.2]\nstage = \"weight\"\n"
        "[[displacements]]\nregion = \"right\"\ny = 0.1\nstage = \"drive\"\n"
        "[[stages]]\nname = \"weight\"\nto = 1\n[[stages]]\nname = \"drive\"\nto = 1\n" +
        tied;
    const CaseFile input = parse_case(text, (directory / "stages.toml").string());
    Silent silent;
    return run_damage_analysis(build_model(input), damage_options(input, 1), silent);
  };
  const DamageResult tied = run("[elements]\nglued = [\"half\"]\n"), bonds = run("");
  EXPECT_LT(tied.energy_error, 1e-11);
  EXPECT_NEAR(tied.last.load, bonds.last.load, 0.02 * std::abs(bonds.last.load))
      << "triangles of a twelfth of a body that bends are too stiff by 1.3 %";
}

}  // namespace
}  // namespace perilink
