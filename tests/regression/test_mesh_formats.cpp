// One body from files of several formats, and bodies of divided quadrilaterals and hexahedra.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "support/whole_run.hpp"

namespace perilink {
namespace {

const std::string data = PERILINK_SOURCE_DIR "/tests/data/";

/// A plate of 4 x 2 with a pre-crack from (2, 0) to (2, 1), pulled apart.
std::string plate(const std::string& file, const std::string& more) {
  return "regions = [{name = \"plate\", group = \"plate\"}, {name = \"left\", group = \"left\"},\n"
         "  {name = \"right\", group = \"right\"}]\n[body]\nmesh = \"" +
         file + "\"\n" + more;
}

std::string breaking(const std::string& file) {
  return plate(file,
               "horizon_ratio = 3\n"
               "[[materials]]\nregion = \"plate\"\nyoungs_modulus = 100\nfracture_energy = 1\n"
               "[[supports]]\nregion = \"left\"\nfix = [\"x\", \"y\"]\n"
               "[[displacements]]\nregion = \"right\"\nx = 1\n"
               "[[cracks]]\ngroup = \"crack\"\n"
               "[stop]\nbroken_bonds = 40\n");
}

double peak_of(const std::string& file) {
  const test::WholeRun run(parse_case(breaking(file), data + "case.toml"));
  return run.summary.json["peak_load"].get<double>();
}

/// Only the order of the nodes differs: round-off of some ten sums.
TEST(MeshFormats, OneBodyHasOnePeak) {
  const double expected = peak_of("plate_41.msh");
  EXPECT_GT(expected, 0.0);
  for (const char* file :
       {"plate_41_binary.msh", "plate_22.msh", "plate_22_binary.msh", "plate.inp"}) {
    EXPECT_NEAR(peak_of(file), expected, 1e-9 * expected) << file;
  }
}

/// Uniform tension, which triangles carry exactly: load = E A u / L.
TEST(MeshFormats, DividedQuadrilateralsHaveTheStiffnessOfThePlate) {
  for (const std::string& body :
       {std::string("method = \"linear_elements\"\n"), std::string("horizon_ratio = 3\n")}) {
    std::string text = plate("plate_22.msh", body);
    text.insert(text.find("]\n[body]"), ",\n  {name = \"corner\", group = \"corner\"}");
    text += "[[materials]]\nregion = \"plate\"\nyoungs_modulus = 100\npoissons_ratio = " +
            std::string("0.3333333333333333") +
            "\n[[supports]]\nregion = \"left\"\nfix = [\"x\"]\n"
            "[[supports]]\nregion = \"corner\"\nfix = [\"y\"]\n"
            "[[displacements]]\nregion = \"right\"\nx = 0.04\n[analysis]\ntype = \"elastic\"\n";
    const test::WholeRun run(parse_case(text, data + "case.toml"));
    const double load = run.history("load").back();
    EXPECT_NEAR(load, 100.0 * 2.0 * 0.04 / 4.0, 1e-8) << body;
  }
}

/// Hexahedra beside wedges, with matching diagonals; in units of the mesh and ten times smaller.
TEST(MeshFormats, DividedHexahedraAndWedgesHaveTheStiffnessOfTheBlock) {
  for (const double scale : {1.0, 0.1}) {
    const std::string text = fmt::format(
        "regions = [{{name = \"block\", group = \"block\"}},\n"
        "  {{name = \"left\", x = [0, 0], y = [0, {0}], z = [0, {0}]}},\n"
        "  {{name = \"right\", x = [{1}, {1}], y = [0, {0}], z = [0, {0}]}}]\n"
        "[body]\nproblem = \"three_dimensional\"\nmethod = \"linear_elements\"\n"
        "mesh = \"block_22.msh\"\nmesh_scale = {0}\n"
        "[[materials]]\nregion = \"block\"\nyoungs_modulus = 100\npoissons_ratio = 0.25\n"
        "[[supports]]\nregion = \"left\"\nfix = [\"x\"]\n"
        "[[symmetry]]\naxis = \"y\"\nat = 0\n[[symmetry]]\naxis = \"z\"\nat = 0\n"
        "[[displacements]]\nregion = \"right\"\nx = {2}\n[analysis]\ntype = \"elastic\"\n",
        scale, 2.0 * scale, 0.02 * scale);
    const test::WholeRun run(parse_case(text, data + "case.toml"));
    EXPECT_NEAR(run.history("load").back(), 100.0 * scale * scale * 0.01, 1e-9) << scale;
  }
}

}  // namespace
}  // namespace perilink
