#include "analysis/quasistatic/equilibrium/mechanism.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <string>

#include "solver/not_positive_definite.hpp"

namespace perilink {
namespace {

/// Pivots over the diagonal: mechanisms leave 1e-17 to 1e-15.
constexpr double none = 1e-14;

/// Where an unknown acts; empty for those of the nodes of elements.
std::string place_of(Index unknown, const Unknowns& unknowns, const Particles* particles) {
  for (std::size_t slot = 0; particles && slot < unknowns.number.size(); ++slot) {
    if (unknowns.number[slot] != unknown) continue;
    const Index particle = static_cast<Index>(slot) / unknowns.width;
    return fmt::format(", at ({:.6g})", fmt::join(particles->position(particle), ", "));
  }
  return {};
}

}  // namespace

void factorize_stiffness(Factor& factor, const SparseMatrix& stiffness, const Unknowns& unknowns,
                         const Particles* particles) {
  Index softest = no_index;
  try {
    factor.factorize(stiffness, unknowns.owners());
    const SoftestPivot pivot = factor.statistics().softest;
    if (pivot.ratio > none) return;
    softest = pivot.unknown;
  } catch (const NotPositiveDefinite& error) {
    softest = error.unknown();
  }
  throw NotPositiveDefinite("part of the body can move freely" +
                                place_of(softest, unknowns, particles) +
                                ", or it is too slender to tell: its stiffness matrix is singular "
                                "to working precision",
                            softest);
}

}  // namespace perilink
