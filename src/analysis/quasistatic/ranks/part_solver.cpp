#include "analysis/quasistatic/ranks/part_solver.hpp"

#include <algorithm>
#include <utility>

#include "solver/factor_routes.hpp"

namespace perilink {

PartSolver::PartSolver(Ranks& ranks, BodyPart part)
    : ranks_(ranks),
      part_(std::move(part)),
      factor_(make_factor(FactorRoute::in_place, 1)),
      layer_(ranks.make_ghost_layer(part_.owned(), part_.ghosts, part_.unknowns.width)),
      motion_(part_.unknowns.number.size(), 0.0),
      coarse_(static_cast<std::size_t>(part_.coarse.rows()), 0.0) {
  std::vector<Index> groups(coarse_.size());
  for (std::size_t k = 0; k < groups.size(); ++k) {
    groups[k] = static_cast<Index>(k) / part_.motions;
  }
  factor_->factorize(part_.coarse, groups);
  part_.coarse = {};
}

GradientsReport PartSolver::search(std::span<const double> right, std::span<double> solution,
                                   double enough, double scale, int most_iterations) {
  return ranks_.conjugate_gradients(
      [&](std::span<const double> q, std::span<double> result) { multiply(q, result); },
      [&](std::span<const double> r, std::span<double> z) { precondition(r, z); }, right, solution,
      enough, scale, most_iterations);
}

/// The own rows of K q: forces on ghosts are the business of their owners.
void PartSolver::multiply(std::span<const double> q, std::span<double> result) {
  const std::vector<Index>& number = part_.unknowns.number;
  for (std::size_t slot = 0; slot < number.size(); ++slot) {
    if (number[slot] >= 0) motion_[slot] = q[number[slot]];
  }
  layer_->update(motion_);
  internal_force(part_.network, part_.secants(), motion_, forces_);
  for (std::size_t slot = 0; slot < number.size(); ++slot) {
    if (number[slot] >= 0) result[number[slot]] = forces_.forces[slot];
  }
}

void PartSolver::precondition(std::span<const double> residual, std::span<double> result) {
  const Unknowns& unknowns = part_.unknowns;
  const int width = unknowns.width, motions = part_.motions;
  std::fill(coarse_.begin(), coarse_.end(), 0.0);
  const auto for_each_own = [&](auto visit) {
    for (Index p = 0; p < part_.owned(); ++p) {
      double* const box = coarse_.data() + static_cast<std::size_t>(part_.boxes[p]) * motions;
      for (int a = 0; a < width; ++a) {
        if (unknowns.at(p, a) >= 0) visit(p, a, unknowns.at(p, a), box);
      }
    }
  };
  const auto row = [&](Index p, int a) -> const std::array<double, 6>& {
    return part_.rows[static_cast<std::size_t>(p) * width + a];
  };
  for_each_own([&](Index p, int a, Index unknown, double* box) {
    for (int m = 0; m < motions; ++m) box[m] += row(p, a)[m] * residual[unknown];
  });
  ranks_.sum(coarse_);
  factor_->solve(coarse_, coarse_);
  for_each_own([&](Index p, int a, Index unknown, const double* box) {
    const double* block = part_.blocks.data() + (static_cast<std::size_t>(p) * width + a) * width;
    double sum = 0.0;
    for (int b = 0; b < width; ++b) {
      if (unknowns.at(p, b) >= 0) sum += block[b] * residual[unknowns.at(p, b)];
    }
    for (int m = 0; m < motions; ++m) sum += row(p, a)[m] * box[m];
    result[unknown] = sum;
  });
}

}  // namespace perilink
