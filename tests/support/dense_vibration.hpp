#pragma once

#include <Eigen/Dense>
#include <numbers>

#include "analysis/dynamics/inertia.hpp"
#include "assembly/internal_force.hpp"
#include "discretization/lattices/make_body.hpp"
#include "support/analysis_bodies.hpp"

namespace perilink::test {

/// Returns the dense stiffness of the unknown components, column by column from internal forces.
inline Eigen::MatrixXd dense_stiffness_of_unknowns(const AnalysisBody& body) {
  const std::vector<Index>& number = body.unknowns.number;
  Eigen::MatrixXd matrix(body.unknowns.count, body.unknowns.count);
  std::vector<double> motion(number.size(), 0.0);
  for (std::size_t column = 0; column < number.size(); ++column) {
    if (number[column] == no_index) continue;
    motion[column] = 1.0;
    const InternalForce internal = internal_force(body.network, intact(body.network), motion);
    for (std::size_t row = 0; row < number.size(); ++row) {
      if (number[row] != no_index) matrix(number[row], number[column]) = internal.forces[row];
    }
    motion[column] = 0.0;
  }
  return matrix;
}

/// Returns the period of the slowest vibration after `free` modes without energy, from dense
/// matrices.
inline double dense_period(const AnalysisBody& body, const Inertia& inertia, Index free = 0) {
  Eigen::VectorXd mass(body.unknowns.count);
  for (std::size_t slot = 0; slot < inertia.mass.size(); ++slot) {
    const Index number = body.unknowns.number[slot];
    if (number != no_index) mass[number] = inertia.mass[slot];
  }
  const Eigen::VectorXd root = mass.cwiseSqrt().cwiseInverse();
  const Eigen::MatrixXd scaled =
      root.asDiagonal() * dense_stiffness_of_unknowns(body) * root.asDiagonal();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(scaled, Eigen::EigenvaluesOnly);
  return 2.0 * std::numbers::pi / std::sqrt(solver.eigenvalues()[free]);
}

/// Returns a cantilever of `length` by `height` spacings, clamped at its left end.
inline AnalysisBody cantilever(int length, int height) {
  LatticeInput input = body_input({"beam", Pattern::rectangular, Surface::none}, height);
  const double spacing = input.spacing;
  input.solid = {{{0.0, 0.0, 0.0}, {length * spacing, height * spacing, 0.0}}};
  AnalysisBody body = free_body(build_network(make_body(input), network_input(input)));
  number(body, [&](Index i, int) { return body.network.particles.position(i)[0] < 0.5 * spacing; });
  return body;
}

}  // namespace perilink::test
