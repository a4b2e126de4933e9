#pragma once

#include <memory>
#include <span>
#include <string>

#include "solver/factor.hpp"

namespace perilink {

/// How a factor follows the removal of a bond.
enum class FactorRoute {
  in_place,        ///< our LDL' downdate on the supernodal pattern
  cholmod_updown,  ///< CHOLMOD's simplicial update/downdate, the reference of the tests
  refactorize,     ///< numerical factorisation from the changed matrix, the yardstick
};

/// \param threads  threads that the factor may use; results do not depend on it
std::unique_ptr<Factor> make_factor(FactorRoute route, int threads);

/// Size and cost of the factor of a matrix from its pattern alone: orders and analyses, computes no
/// number of L.
FactorStatistics estimate_factor(const SparseMatrix& matrix, std::span<const Index> groups);

/// Name of a route as the case file spells it.
std::string to_string(FactorRoute route);

/// Factors that make_factor has made in this process: tests count those that nobody needs.
int factors_made();

}  // namespace perilink
