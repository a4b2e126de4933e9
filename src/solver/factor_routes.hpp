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

/// The order, in postorder, in which a factor of a matrix of this pattern would eliminate its rows:
/// matrices that come in it are factorised where they are.
std::vector<Index> elimination_order(const SparseMatrix& lower);

/// Factors that make_factor has made in this process: tests count those that nobody needs.
int factors_made();

}  // namespace perilink
