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
  double factorization = 0.0;  ///< ordering and symbolic analysis too; that of boxes
  double solve = 0.0;          ///< with the step of refinement
};

/// Static equilibrium at load factor 1.
struct ElasticResult {
  std::vector<double> displacement;    ///< shape (particles, width) [length], rotations [-]
  std::vector<double> forces;          ///< that hold the particles so, InternalForce::forces
  std::vector<double> secants, axial;  ///< Secants where pre-cracks may close; else empty
  double strain_energy = 0.0;          ///< summed over the elements [force length]
  double work = 0.0;                   ///< that loads and reactions do [force length]
  double residual = 0.0;               ///< |f - K u| / |f| after one step of refinement
  FactorStatistics factor;             ///< the stiffness has, or that of boxes
  Index subdomains = 0;                ///< that conjugate gradients have taken; 0: a factor
  int iterations = 0;                  ///< conjugate gradients
  double error = 0.0;                  ///< they leave, over the solution, in the norm of energy
  ElasticSeconds seconds;
};

/// One assembly, one factorisation, one solve; or conjugate gradients. Where bonds across a
/// pre-crack close, an Equilibrium before that finds which of them do.
/// \throws CracksSeparate where nothing but closed bonds could hold a piece that is pulled away
/// \throws SolverError when the stiffness matrix is not positive definite, the iterations end
///         before the tolerance, or work and energy are out of balance by a hundredth
ElasticResult run_elastic_analysis(const LoadedNetwork& problem,
                                   const ElasticOptions& options = {});

/// Finds which bonds across pre-cracks are closed at load factor 1.
/// \return the secants of all elements and those of their axial stiffness
/// \throws CracksSeparate as run_elastic_analysis()
std::pair<std::vector<double>, std::vector<double>> find_closed_cracks(
    const LoadedNetwork& problem, const ElasticOptions& options);

/// By a factor, with linear finite elements in place of bonds.
ElasticResult run_elastic_analysis(const LinearElements& elements, const Unknowns& unknowns,
                                   const Loads& loads, int threads);

}  // namespace perilink
