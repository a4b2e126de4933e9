#pragma once

#include <array>
#include <functional>
#include <span>
#include <vector>

#include "base/block.hpp"
#include "solver/conjugate_gradients.hpp"

namespace perilink {

/// One number per vector of a block.
using BlockRow = std::array<double, block_width>;

/// Largest number of parts of vectors that threads process at once. Sums are taken over the parts,
/// so they are independent of the number of threads.
inline constexpr std::size_t most_parts = 8;

/// Called for rows [begin, end) of results as soon as they are computed and still in the cache.
/// Rows of one part come in order. Several threads may call it for their own parts.
using RowsDone = std::function<void(std::size_t part, std::size_t begin, std::size_t end)>;

/// Computes results = A vectors for a block of vectors, shape (n, block_width).
template <class Number>
using BlockMap = std::function<void(std::span<const Number> vectors, std::span<Number> results,
                                    const RowsDone& done)>;

/// Returns a block map of a function; it calls `done` once for all rows.
template <class Number, class Map>
BlockMap<Number> as_block_map(Map map) {
  return [map](std::span<const Number> vectors, std::span<Number> results, const RowsDone& done) {
    map(vectors, results);
    done(0, 0, results.size() / block_width);
  };
}

/// Sums numbers over processes that hold parts of the vectors.
using SumOverParts = std::function<void(std::span<double> parts)>;

/// Directions, their products and preconditioned residuals, shape (n, block_width). Reusing them
/// for several solutions saves page faults.
template <class Number>
struct BlockSpace {
  BlockVector<Number> p, q, z;
};

/// Block conjugate gradients (O'Leary 1980, The block conjugate gradient algorithm and related
/// methods). Each solution uses the directions of all right sides, which needs fewer steps, and the
/// product is applied to all at once. Linearly dependent directions are skipped. Stops when the
/// last right side has converged. Vectors have shape (n, block_width).
/// \param right     overwritten
/// \param solution  set to the solution, or to its part since the last correction
/// \param sizes     reference energy of each solution. A solution has converged when its missing
///     energy is at most enough^2 times this size.
/// \param correct   for numbers of few digits: adds the solution to one of more digits and sets the
///     right side to its residual. It is called when the estimated error has fallen by five digits.
///     If the true error has not fallen by one digit, the solution fails. Empty: no corrections
/// \param sum       for vectors that are parts of whole ones; empty: whole vectors
/// \param space     memory to reuse; null: own memory
/// \return iterations and the largest error over the square root of its size
/// \throws NotPositiveDefinite if A is not positive definite
template <class Number>
GradientsReport block_conjugate_gradients(
    const BlockMap<Number>& product, const BlockMap<Number>& precondition, std::span<Number> right,
    std::span<Number> solution, const BlockRow& sizes, double enough, int most_iterations,
    const std::function<void(std::span<const Number> solution, std::span<Number> right)>& correct =
        {},
    const SumOverParts& sum = {}, BlockSpace<Number>* space = nullptr);

/// Replaces columns by linear combinations, which may be fewer: blocks <- blocks shares. Each block
/// has block_width columns, shape (n, block_width).
/// \param shares  coefficients, shape (old, new); new is a multiple of block_width
void recombine(std::vector<BlockVector<double>>& blocks, std::span<const double> shares);

/// Computes result += columns weights, columns of shape (n, block_width).
void add_combination(std::span<const double> columns, std::span<const double> weights,
                     std::span<double> result);

}  // namespace perilink
