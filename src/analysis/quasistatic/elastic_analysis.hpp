#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "analysis/quasistatic/subdomains/subdomain_solver.hpp"
#include "assembly/linear_elements.hpp"
#include "network/loaded_network.hpp"
#include "network/network.hpp"
#include "solver/factor.hpp"
#include "solver/linear_solver.hpp"

namespace perilink {

struct ElasticOptions {
  int threads = 1;
  LinearSolver solver = LinearSolver::automatic;
  SubdomainSolverOptions subdomains = {};
};

/// Whether conjugate gradients solve a problem: where they are chosen, or take less time than a
/// factor of the stiffness and nothing carries particles (docs/theory/large_bodies.md).
/// Ranks share the work of conjugate gradients alone, and take them wherever they can.
bool is_for_subdomains(const LoadedNetwork& problem, LinearSolver solver,
                       const Ranks* ranks = nullptr);

/// Wall seconds of the phases of an elastic analysis.
struct ElasticSeconds {
  double assembly = 0.0;       ///< stiffness matrix and right-hand side
  double factorization = 0.0;  ///< includes ordering, symbolic analysis and subdomains
  double solve = 0.0;          ///< includes the refinement step
};

/// Static equilibrium at load factor 1.
struct ElasticResult {
  std::vector<double> displacement;    ///< shape (particles, width) [length], rotations [-]
  std::vector<double> forces;          ///< internal forces, InternalForce::forces
  std::vector<double> secants, axial;  ///< Secants if pre-cracks may close; else empty
  double strain_energy = 0.0;          ///< summed over the elements [force length]
  double work = 0.0;                   ///< by loads and reactions [force length]
  double residual = 0.0;               ///< |f - K u| / |f| after one step of refinement
  FactorStatistics factor;             ///< factor of the stiffness or of the coarse space
  Index subdomains = 0;                ///< used by conjugate gradients; 0: a factor was used
  int iterations = 0;                  ///< conjugate-gradient iterations
  double error = 0.0;                  ///< relative error of conjugate gradients in the energy norm
  ElasticSeconds seconds;
};

/// Solves for static equilibrium by one factorisation and one solve, or by conjugate gradients. If
/// bonds across a pre-crack may close, an Equilibrium finds their contact states first.
/// \throws CracksSeparate if only closed bonds could hold a piece that is pulled away
/// \throws SolverError if the stiffness matrix is not positive definite, the iterations do not
///         converge, or work and energy differ by more than a hundredth
ElasticResult run_elastic_analysis(const LoadedNetwork& problem,
                                   const ElasticOptions& options = {});

/// Finds which bonds across pre-cracks are closed at load factor 1.
/// \return secant stiffness ratios of all elements, and ratios of their axial stiffness
/// \throws CracksSeparate if only closed bonds could hold a piece that is pulled away
std::pair<std::vector<double>, std::vector<double>> find_closed_cracks(
    const LoadedNetwork& problem, const ElasticOptions& options);

/// Solves for static equilibrium of linear finite elements by a factor.
ElasticResult run_elastic_analysis(const LinearElements& elements, const Unknowns& unknowns,
                                   const Loads& loads, int threads);

}  // namespace perilink
