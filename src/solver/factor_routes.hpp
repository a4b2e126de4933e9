#pragma once

#include <memory>
#include <span>
#include <vector>

#include "solver/factor.hpp"
#include "solver/factor_route.hpp"

namespace perilink {

/// \param threads  threads that the factor may use; results do not depend on it
std::unique_ptr<Factor> make_factor(FactorRoute route, int threads);

/// Size and cost of the factor of a matrix from its pattern alone: orders and analyses, computes no
/// number of L.
FactorStatistics estimate_factor(const SparseMatrix& matrix, std::span<const Index> groups);

/// Factors that make_factor has made in this process: tests count those that nobody needs.
int factors_made();

}  // namespace perilink
