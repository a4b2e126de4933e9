#pragma once

#include <vector>

#include "assembly/linear_elements.hpp"
#include "network/loaded_network.hpp"
#include "network/network.hpp"
#include "solver/factor.hpp"

namespace perilink {

/// Wall seconds of the phases of an elastic analysis.
struct ElasticSeconds {
  double assembly = 0.0;       ///< stiffness matrix and right-hand side
  double factorization = 0.0;  ///< ordering and symbolic analysis too
  double solve = 0.0;          ///< with the step of refinement
};

/// Static equilibrium at load factor 1.
struct ElasticResult {
  std::vector<double> displacement;  ///< shape (particles, width) [length], rotations [-]
  double strain_energy = 0.0;        ///< [force length]
  double residual = 0.0;             ///< |f - K u| / |f| after one step of refinement
  FactorStatistics factor;
  ElasticSeconds seconds;
};

/// One assembly, one factorisation, one solve.
/// \throws SolverError when the stiffness matrix is not positive definite
ElasticResult run_elastic_analysis(const LoadedNetwork& problem, int threads);

/// The same with linear finite elements in place of bonds.
ElasticResult run_elastic_analysis(const LinearElements& elements, const Unknowns& unknowns,
                                   const Loads& loads, int threads);

}  // namespace perilink
