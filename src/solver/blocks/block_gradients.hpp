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

/// Parts of vectors, at most, that threads work on at the same time: sums are those of the parts,
/// whatever the number of threads.
inline constexpr std::size_t most_parts = 8;

/// Told of the rows [begin, end) of results as soon as they are there, all of a part in order: they
/// are still in the cache. Several threads may tell of parts of their own.
using RowsDone = std::function<void(std::size_t part, std::size_t begin, std::size_t end)>;

/// results = A vectors of a block of vectors, shape (n, block_width).
template <class Number>
using BlockMap = std::function<void(std::span<const Number> vectors, std::span<Number> results,
                                    const RowsDone& done)>;

/// A map of vectors to results that tells of all rows at its end.
template <class Number, class Map>
BlockMap<Number> as_block_map(Map map) {
  return [map](std::span<const Number> vectors, std::span<Number> results, const RowsDone& done) {
    map(vectors, results);
    done(0, 0, results.size() / block_width);
  };
}

/// Adds up numbers that several processes have their parts of.
using SumOverParts = std::function<void(std::span<double> parts)>;

/// Directions, their products and residuals behind the preconditioner, shape (n, block_width): kept
/// from one search to the next, which saves page faults.
template <class Number>
struct BlockSpace {
  BlockVector<Number> p, q, z;
};

/// Block conjugate gradients (O'Leary 1980, The block conjugate gradient algorithm and related
/// methods): every right side is looked for among the directions of all of them, so that there are
/// fewer steps than for each by itself, and the product is applied to all at once. Directions that
/// have become one are left out. Ends where the last right side has got there. Vectors have shape
/// (n, block_width).
/// \param right     used up
/// \param solution  from zero; what has come since the last correction
/// \param sizes     energies that errors count by: each ends where the root of the energy that is
///                  missing is no larger than `enough` times the root of its own
/// \param correct   where numbers have few digits: adds the solution to one of more digits and puts
///                  the residual of that into the right side. It is called whenever errors seem to
///                  have fallen by five digits; where they have not by one, the search ends
///                  without an answer. Empty: never
/// \param sum       where vectors here are parts of whole ones; empty: they are whole
/// \param space     null: memory of its own
/// \return iterations, and the largest error of all, as it counts
/// \throws NotPositiveDefinite where A is not
template <class Number>
GradientsReport block_conjugate_gradients(
    const BlockMap<Number>& product, const BlockMap<Number>& precondition, std::span<Number> right,
    std::span<Number> solution, const BlockRow& sizes, double enough, int most_iterations,
    const std::function<void(std::span<const Number> solution, std::span<Number> right)>& correct =
        {},
    const SumOverParts& sum = {}, BlockSpace<Number>* space = nullptr);

/// blocks <- blocks shares: columns, block_width of them in each block of shape (n, block_width),
/// go over to combinations of them, which may be fewer.
/// \param shares  what each new column has of each old one, shape (old, new); new a multiple of
///                block_width
void recombine(std::vector<BlockVector<double>>& blocks, std::span<const double> shares);

/// result += columns weights, the columns of shape (n, block_width).
void add_combination(std::span<const double> columns, std::span<const double> weights,
                     std::span<double> result);

}  // namespace perilink
