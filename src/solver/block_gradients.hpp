#pragma once

#include <array>
#include <functional>
#include <span>
#include <vector>

#include "base/block.hpp"
#include "solver/conjugate_gradients.hpp"

namespace perilink {

/// One number for each of the vectors of a block.
using BlockRow = std::array<double, block_width>;

/// Adds up numbers that several processes have their parts of.
using SumOverParts = std::function<void(std::span<double> parts)>;

/// conjugate_gradients() of many right sides side by side, from zero: each goes its own way, and
/// products and preconditioner are applied to all of them at once. Ends where the last one has got
/// there. Vectors have shape (n, block_width).
/// \param right  used up
/// \param sizes  energies that errors count by: each ends where the root of the energy that is
///               missing is no larger than `enough` times the root of its own
/// \param sum     where vectors here are parts of whole ones; none: they are whole
/// \return iterations, and the largest error of all, as it counts
/// \throws NotPositiveDefinite where A is not
GradientsReport block_conjugate_gradients(const LinearMap& product, const LinearMap& precondition,
                                          std::span<double> right, std::span<double> solution,
                                          const BlockRow& sizes, double enough, int most_iterations,
                                          const SumOverParts& sum = {});

/// blocks <- blocks shares: columns, block_width of them in each block of shape (n, block_width),
/// go over to combinations of them, which may be fewer.
/// \param shares  what each new column has of each old one, shape (old, new); new a multiple of
///                block_width
void recombine(std::vector<std::vector<double>>& blocks, std::span<const double> shares);

/// result += columns weights, the columns of shape (n, block_width).
void add_combination(std::span<const double> columns, std::span<const double> weights,
                     std::span<double> result);

}  // namespace perilink
