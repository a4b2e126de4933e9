#include "network/builder/tied_cells.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "assembly/internal_force.hpp"
#include "assembly/stiffness.hpp"
#include "discretization/meshes/mesh_body.hpp"
#include "network/builder/network_builder.hpp"
#include "support/simplex_meshes.hpp"

namespace perilink {
namespace {

/// A square of six by six cells; those right of the middle are ordinary elements.
struct TiedHalves {
  explicit TiedHalves(BondModel model = BondModel::bond_based) {
    const Mesh mesh = test::box_mesh(2, 6);
    const std::vector<Index> material(static_cast<std::size_t>(mesh.num_cells()), 0);
    std::vector<std::uint8_t> tied;
    for (Index cell = 0; cell < mesh.num_cells(); ++cell) {
      double x = 0.0;
      for (int k = 0; k < 3; ++k) x += mesh.positions[2 * mesh.cells[3 * cell + k]] / 3.0;
      tied.push_back(x > 0.5 ? 1 : 0);
    }
    body = make_mesh_body(mesh, material, 1.0, tied);
    body.lattice.surface = Surface::calibrated;
    input.problem = Problem::plane_stress;
    input.model = model;
    input.critical_stretch = Constants::continuum;
    input.horizon = 3.0 * body.lattice.spacing;
    input.materials = {{1000.0, 1.0, model == BondModel::micropolar ? 0.2 : 0.0}};
    network = build_network(body, input);
  }

  Body body;
  NetworkInput input;
  Network network;
};

TEST(TiedCells, BondsAreThoseOfTheirPartAlone) {
  const TiedHalves halves;
  const BondedPart part = bonded_part(halves.body, 1.0);
  EXPECT_EQ(part.body.particles.size(), 4 * 7);
  EXPECT_TRUE(std::is_sorted(part.whole_of.begin(), part.whole_of.end()));
  double volume = 0.0;
  for (const double v : part.body.particles.volumes) volume += v;
  EXPECT_NEAR(volume, 0.5, 0.01) << "the vertices of the mesh are a little off";
  EXPECT_EQ(std::count(part.body.facets.tied.begin(), part.body.facets.tied.end(), 1), 6);

  const Network& network = halves.network;
  EXPECT_EQ(network.particles.size(), 49);
  ASSERT_TRUE(network.cells);
  EXPECT_EQ(network.cells->cells.size(), 36);
  EXPECT_EQ(network.num_bonds() + network.num_edges_of_cells(), network.first_slip_spring);
  const std::vector<std::uint8_t> in_cells = vertices_of_cells(network);
  EXPECT_EQ(std::count(in_cells.begin(), in_cells.end(), 1), 28);
  for (Index b = 0; b < network.first_slip_spring; ++b) {
    const bool edge = b >= network.num_bonds();
    EXPECT_EQ(network.stiffness[b] == 0.0, edge);
    EXPECT_EQ(network.has_limit(b), !edge);
    for (const Index i : {network.bonds.first[b], network.bonds.second[b]}) {
      const double x = network.particles.position(i)[0];
      EXPECT_TRUE(edge ? x > 0.45 : x < 0.55);
    }
  }
  EXPECT_TRUE(find_loose_particles(network).empty());
}

/// Forces are the derivatives of the energy, and stiffness that of the forces.
TEST(TiedCells, ForcesAndStiffnessBelongToTheEnergy) {
  for (const BondModel model : {BondModel::bond_based, BondModel::micropolar}) {
    const TiedHalves halves(model);
    const Network& network = halves.network;
    const std::vector<double> intact(static_cast<std::size_t>(network.num_elements()), 1.0);
    const auto size = static_cast<std::size_t>(network.particles.size() * network.width());
    std::vector<double> u(size);
    for (std::size_t k = 0; k < size; ++k) u[k] = 1e-3 * std::sin(3.0 * static_cast<double>(k));
    const InternalForce at = internal_force(network, intact, u);
    double work = 0.0;
    for (std::size_t k = 0; k < size; ++k) work += 0.5 * at.forces[k] * u[k];
    EXPECT_NEAR(work, at.energy, 1e-12 * at.energy);
    const Unknowns unknowns = number_unknowns(network.width(), std::vector<std::uint8_t>(size, 0),
                                              std::vector<double>(size, 0.0));
    const auto lower = assemble_stiffness(network, intact, unknowns);
    const Eigen::Map<const Eigen::VectorXd> motion(u.data(), static_cast<Index>(size));
    const Eigen::VectorXd forces = lower.selfadjointView<Eigen::Lower>() * motion;
    double largest = 0.0, error = 0.0;
    for (std::size_t k = 0; k < size; ++k) {
      largest = std::max(largest, std::abs(at.forces[k]));
      error = std::max(error, std::abs(forces[static_cast<Index>(k)] - at.forces[k]));
    }
    EXPECT_LT(error, 1e-12 * largest);
    std::vector<long double> fine(u.begin(), u.end());
    ForcesAndEnergy<long double> exact;
    internal_force(network, intact, fine, exact);
    EXPECT_NEAR(static_cast<double>(exact.energy), at.energy, 1e-12 * at.energy);
  }
}

}  // namespace
}  // namespace perilink
