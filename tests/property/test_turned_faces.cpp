// Squares and cubes on meshes, rotated against the axes, in tension across a weak face between
// their halves. They have the strength and the fracture energy of the face.

#include <gtest/gtest.h>

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <ostream>
#include <string>

#include "model/from_case/configure.hpp"
#include "support/halved_meshes.hpp"
#include "support/strip_case.hpp"
#include "support/whole_run.hpp"

namespace perilink {
namespace {

using namespace test;

constexpr double face_strength_wanted = 3.0, face_energy = 0.1;

struct TurnedFace {
  std::string name;
  int dim;
  std::string model;
  int count;             ///< cells along a side
  double cell;           ///< [length]
  double stiffer = 1.0;  ///< modulus of the second half over the modulus of the first
};

/// Prints the name; otherwise CTest would list the bytes of a case.
std::ostream& operator<<(std::ostream& out, const TurnedFace& face) { return out << face.name; }

/// Mesh file beside the directories of tests, which every run empties.
class HalvedMesh {
 public:
  explicit HalvedMesh(const TurnedFace& tested)
      : path_(std::filesystem::path(testing::TempDir()) /
              fmt::format("perilink_{}_{}.msh", getpid(), tested.name)) {
    write_text(path_, halved_mesh_text(tested.dim, tested.count, tested.count * tested.cell));
  }
  ~HalvedMesh() { std::filesystem::remove(path_); }
  HalvedMesh(const HalvedMesh&) = delete;
  HalvedMesh& operator=(const HalvedMesh&) = delete;

  std::string file() const { return path_.filename().string(); }
  /// Returns the path of a case file beside the mesh.
  std::string case_path() const { return (path_.parent_path() / "case.toml").string(); }

 private:
  std::filesystem::path path_;
};

/// \param place  position of the interface
CaseFile turned_case(const TurnedFace& tested, const HalvedMesh& mesh, const std::string& place) {
  const bool space = tested.dim == 3;
  std::string text = fmt::format(
      "[body]\nproblem = \"{}\"\nmodel = \"{}\"\nmesh = \"{}\"\n"
      "horizon_ratio = {}\n",
      space ? "three_dimensional" : "plane_stress", tested.model, mesh.file(), space ? 2 : 3);
  for (const char* name : {"first", "second", "left", "right"}) {
    text += fmt::format("[[regions]]\nname = \"{0}\"\ngroup = \"{0}\"\n", name);
  }
  const std::string ratio = tested.model == "micropolar" ? "poissons_ratio = 0.2\n" : "";
  for (const auto& [name, factor] :
       {std::pair("first", 1.0), std::pair("second", tested.stiffer)}) {
    text += fmt::format(
        "[[materials]]\nregion = \"{}\"\nyoungs_modulus = {}\nfracture_energy = \"infinite\"\n{}",
        name, 30000.0 * factor, ratio);
  }
  text += fmt::format(
      "[[interfaces]]\n{}\nfracture_energy = {}\ntensile_strength = {}\nsoftening = \"linear\"\n"
      "softening_error = 0.03\n",
      place, face_energy, face_strength_wanted);
  const auto [x, y, z] = turned({0.2, 0.0, 0.0}, tested.dim);
  text += fmt::format(
      "[[supports]]\nregion = \"left\"\nfix = [\"x\", \"y\"{}]\n"
      "[[displacements]]\nregion = \"right\"\nx = {}\ny = {}\n{}[stop]\nload_fraction = 1e-5\n",
      space ? ", \"z\"" : "", x, y, space ? fmt::format("z = {}\n", z) : "");
  return parse_case(text, mesh.case_path());
}

class TurnedFaces : public testing::TestWithParam<TurnedFace> {};

TEST_P(TurnedFaces, BearTheirStrengthAndTakeTheirFractureEnergy) {
  const TurnedFace& tested = GetParam();
  const HalvedMesh mesh(tested);
  const WholeRun run(turned_case(tested, mesh, "group = \"face\""));
  const double area = std::pow(tested.count * tested.cell, tested.dim - 1);
  const auto told = [&](const char* key) { return run.summary.json.at(key).get<double>(); };
  const double force = face_strength_wanted * area, energy = face_energy * area;
  EXPECT_NEAR(told("peak_load"), force, 0.03 * force);
  EXPECT_NEAR(told("dissipated_energy"), energy, 0.03 * energy);
  EXPECT_LT(told("energy_error"), 1e-9);
}

INSTANTIATE_TEST_SUITE_P(Meshes, TurnedFaces,
                         testing::Values(TurnedFace{"bond_based", 2, "bond_based", 12, 5.0},
                                         TurnedFace{"micropolar", 2, "micropolar", 12, 5.0},
                                         TurnedFace{"stiffer_half", 2, "bond_based", 12, 5.0, 4.0},
                                         TurnedFace{"bond_based_cube", 3, "bond_based", 6, 6.0},
                                         TurnedFace{"micropolar_cube", 3, "micropolar", 4, 6.0}),
                         [](const auto& tested) { return tested.param.name; });

/// A physical group and its two sides select identical bonds.
TEST(FacesOfGroups, AreThoseBetweenTheHalves) {
  for (const TurnedFace& tested : {TurnedFace{"square", 2, "bond_based", 8, 5.0, 4.0},
                                   TurnedFace{"cube", 3, "bond_based", 4, 6.0, 4.0}}) {
    const HalvedMesh mesh(tested);
    const auto laws = [&](const std::string& place) {
      return build_model(turned_case(tested, mesh, place)).network.law_of;
    };
    const std::vector<Index> by_group = laws("group = \"face\"");
    EXPECT_EQ(by_group, laws("between = [\"first\", \"second\"]")) << tested.name;
    EXPECT_NE(std::find(by_group.begin(), by_group.end(), 1), by_group.end());
    expect_refused(turned_case(tested, mesh, "group = \"fase\""), "interfaces[1].group", "fase");
    expect_refused(turned_case(tested, mesh, "group = \"left\""), "interfaces[1].group",
                   "crosses no bond");
  }
}

}  // namespace
}  // namespace perilink
