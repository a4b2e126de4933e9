// Conjugate gradients with subdomains give the equilibrium of a factor, for any bonds, supports and
// loads.

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "analysis/quasistatic/elastic_analysis.hpp"
#include "base/error.hpp"
#include "io/case/case_file.hpp"
#include "model/from_case/configure.hpp"
#include "support/gmsh_texts.hpp"
#include "support/lattice_networks.hpp"
#include "support/simplex_meshes.hpp"
#include "support/slender_bodies.hpp"
#include "support/temporary_directory.hpp"

namespace perilink {
namespace {

using namespace test;

/// The error in the energy norm is below 1e-12. The error of displacements may be larger by the
/// square root of the condition number, 1e3 for these bodies.
constexpr double force_tolerance = 1e-12, closeness = 1e-9;

void expect_equal_answers(const LoadedNetwork& body) {
  const ElasticResult direct = run_elastic_analysis(body, {.solver = LinearSolver::direct});
  const ElasticResult found = run_elastic_analysis(
      body,
      {.solver = LinearSolver::iterative, .subdomains = {.tolerance = force_tolerance, .edge = 4}});
  EXPECT_EQ(direct.subdomains, 0);
  EXPECT_GT(found.subdomains, 2);
  EXPECT_LT(found.error, force_tolerance);
  double largest = 0.0, difference = 0.0;
  for (std::size_t k = 0; k < direct.displacement.size(); ++k) {
    if (static_cast<int>(k) % body.unknowns.width >= body.network.dim()) continue;
    largest = std::max(largest, std::abs(direct.displacement[k]));
    difference = std::max(difference, std::abs(direct.displacement[k] - found.displacement[k]));
  }
  EXPECT_LT(difference, closeness * largest);
  EXPECT_NEAR(found.strain_energy, direct.strain_energy, closeness * direct.strain_energy);
  EXPECT_LT(found.residual, 1e-7);
}

struct SolverCase {
  const char* name;
  std::string body;  ///< keys of [body]
  bool space = false;
  std::string more = {};      ///< tables of the case
  std::string material = {};  ///< keys of [[materials]]
};

void PrintTo(const SolverCase& block, std::ostream* out) { *out << block.name; }

class Solvers : public testing::TestWithParam<SolverCase> {};

TEST_P(Solvers, Agree) {
  const SolverCase& block = GetParam();
  const TemporaryDirectory directory;
  std::ofstream(directory / "box.msh")
      << gmsh_text(box_mesh(block.space ? 3 : 2, 9), {9, 9, 9}, {0, 0, 0});
  const std::string z = block.space ? "z = [0, 9]\n" : "", zero = block.space ? "z = 0.0\n" : "";
  std::string text = "[body]\nhorizon_ratio = 2.0\n" + block.body;
  if (block.space) text += "problem = \"three_dimensional\"\n";
  text += "[[regions]]\nname = \"block\"\nx = [0, 9]\ny = [0, 9]\n" + z;
  text += "[[regions]]\nname = \"base\"\nx = [0, 9]\ny = [0, 1.5]\n" + z;
  text += "[[regions]]\nname = \"cap\"\nx = [0, 9]\ny = [7.5, 9]\n" + z;
  text += "[[materials]]\nregion = \"block\"\nyoungs_modulus = 3604.0\n";
  text += "fracture_energy = \"infinite\"\n" + block.material;
  text += "[[displacements]]\nregion = \"base\"\nx = 0.0\ny = 0.0\n" + zero;
  text += "[analysis]\ntype = \"elastic\"\n" + block.more;
  expect_equal_answers(build_model(parse_case(text, (directory / "case.toml").string())));
}

const std::string pulled_cap = "[[displacements]]\nregion = \"cap\"\ny = 1.0\n";
const std::string own_weight =
    "[[loads]]\nregion = \"block\"\nbody_force = [1, 0.5]\n"
    "[[springs]]\nregion = \"cap\"\ntotal = [50, 200]\n";
const std::string in_space =
    "[[loads]]\nregion = \"cap\"\nforce = [30, 100, 10]\n"
    "[[cracks]]\ncorners = [[-1, 4.4, -1], [5, 4.4, -1], [5, 4.4, 10], [-1, 4.4, 10]]\n";
const std::string cracked = "[[cracks]]\npoints = [[-1, 4.4], [5, 4.4]]\n" + pulled_cap;
const std::string reinforced =
    "[[rebar]]\nfrom = [1, 1]\nto = [8, 8]\narea = 0.1\nyoungs_modulus = 1e5\n"
    "bond = \"concrete\"\n" +
    own_weight;

INSTANTIATE_TEST_SUITE_P(
    Blocks, Solvers,
    testing::Values(SolverCase{"square_cracked", "spacing = 0.5\n", false, cracked},
                    SolverCase{"square_of_two", "spacing = 0.5\n", false, own_weight},
                    SolverCase{"reinforced", "spacing = 0.5\n", false, reinforced},
                    SolverCase{"micropolar", "spacing = 0.5\nmodel = \"micropolar\"\n", false,
                               cracked, "poissons_ratio = 0.2\n"},
                    SolverCase{"cloud", "mesh = \"box.msh\"\n", false, own_weight},
                    SolverCase{"glued", "mesh = \"box.msh\"\n", false,
                               own_weight + "[elements]\nglued = [\"cap\"]\n"},
                    SolverCase{"cubic", "spacing = 1\n", true, in_space},
                    SolverCase{"tetrahedra", "mesh = \"box.msh\"\n", true, in_space},
                    SolverCase{"micropolar_cubic", "spacing = 1\nmodel = \"micropolar\"\n", true,
                               in_space, "poissons_ratio = 0.1\n"}),
    [](const auto& block) { return std::string(block.param.name); });

TEST(EquilibriumSolvers, AgreeOnASlenderBody) {
  SlenderCase bar;
  bar.load = SlenderLoad::force_across;
  expect_equal_answers(make_slender(bar));
}

/// The extension of a bond of a state-based lattice loads all neighbours of its ends.
TEST(EquilibriumSolvers, AgreeOnStates) {
  for (const testing_support::StateLatticeCase& lattice : testing_support::state_lattice_cases()) {
    AnalysisBody body =
        free_body(lattice_network(testing_support::state_block(lattice, 6.1)).network);
    const Particles& particles = body.network.particles;
    const int last = body.network.dim() - 1;
    double low = 1e300, high = -1e300;
    for (Index i = 0; i < particles.size(); ++i) {
      low = std::min(low, particles.position(i)[last]);
      high = std::max(high, particles.position(i)[last]);
    }
    for (Index i = 0; i < particles.size(); ++i) {
      if (particles.position(i)[last] > high - 0.1 * (high - low)) {
        body.loads.forces[slot(body, i, 0)] = body.loads.forces[slot(body, i, 1)] = 1.0;
      }
    }
    number(body,
           [&](Index i, int) { return particles.position(i)[last] < low + 0.3 * (high - low); });
    SCOPED_TRACE(testing::PrintToString(lattice));
    expect_equal_answers(body);
  }
}

/// Two halves joined by one particle can rotate about it, even if the load does not cause rotation.
/// A factor finds a zero pivot.
TEST(EquilibriumSolvers, RefuseMechanismsThatNoLoadMoves) {
  SlenderCase bar;
  bar.columns = 80;
  bar.rows = 41;
  bar.load = SlenderLoad::force_along;
  AnalysisBody body = make_slender(bar);
  const Particles& particles = body.network.particles;
  std::vector<std::uint8_t> keep;
  for (Index e = 0; e < body.network.num_elements(); ++e) {
    const auto a = particles.position(body.network.bonds.first[e]);
    const auto b = particles.position(body.network.bonds.second[e]);
    const auto at_hinge = [](std::span<const double> x) { return x[0] == 40.0 && x[1] == 20.0; };
    const bool apart = (a[0] < 40.0) != (b[0] < 40.0) && !at_hinge(a) && !at_hinge(b);
    const bool beside = (a[0] == 40.0) != (b[0] == 40.0) && !at_hinge(a) && !at_hinge(b);
    keep.push_back(!apart && !beside);
  }
  keep_elements(body.network, keep);
  for (const LinearSolver solver : {LinearSolver::direct, LinearSolver::iterative}) {
    EXPECT_THROW(run_elastic_analysis(body, {.solver = solver}), SolverError);
  }
}

TEST(EquilibriumSolvers, ChooseByTheSizeOfTheBody) {
  LoadedNetwork problem;
  problem.network.particles.dim = problem.network.bonds.dim = 3;
  problem.unknowns.count = 1000;
  EXPECT_FALSE(is_for_subdomains(problem, LinearSolver::automatic));
  EXPECT_TRUE(is_for_subdomains(problem, LinearSolver::iterative));
  problem.unknowns.count = 1000000;
  EXPECT_TRUE(is_for_subdomains(problem, LinearSolver::automatic));
  EXPECT_FALSE(is_for_subdomains(problem, LinearSolver::direct));
  problem.unknowns.number = {0, no_index};
  const Unknowns::Share half[] = {{0, 0.5}};
  problem.unknowns.carry(1, half);
  EXPECT_FALSE(is_for_subdomains(problem, LinearSolver::automatic)) << "a particle is embedded";
}

}  // namespace
}  // namespace perilink
