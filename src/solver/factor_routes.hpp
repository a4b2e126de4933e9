#pragma once

#include <memory>
#include <span>
#include <vector>

#include "solver/factor.hpp"
#include "solver/factor_route.hpp"

namespace perilink {

/// Makes a factor.
/// \param threads  number of threads; results do not depend on it
std::unique_ptr<Factor> make_factor(FactorRoute route, int threads);

/// Returns size and cost of a matrix's factor. Orders and analyses the pattern without numerical
/// work.
FactorStatistics estimate_factor(const SparseMatrix& matrix, std::span<const Index> groups);

/// Returns the number of factors made by make_factor() in this process; tests count unneeded ones.
int factors_made();

}  // namespace perilink
