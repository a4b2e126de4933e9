#include "analysis/quasistatic/ranks/part_solver.hpp"

#include <algorithm>
#include <exception>
#include <utility>

#include "assembly/block_forces.hpp"
#include "solver/factor_routes.hpp"

namespace perilink {

void BodyChanges::pack(Parcel& parcel) const {
  parcel.put(elements);
  parcel.put(axial);
  parcel.put(other);
  parcel.put(ground);
}

BodyChanges BodyChanges::unpack(Parcel& parcel) {
  BodyChanges changes;
  parcel.get(changes.elements);
  parcel.get(changes.axial);
  parcel.get(changes.other);
  parcel.get(changes.ground);
  return changes;
}

PartSolver::PartSolver(Ranks& ranks, BodyPart part)
    : ranks_(ranks),
      part_(std::move(part)),
      factor_(make_factor(part_.changes ? FactorRoute::refactorize : FactorRoute::in_place, 1)),
      layer_(ranks, part_.ghosts),
      motion_(part_.unknowns.number.size(), 0.0),
      coarse_(static_cast<std::size_t>(part_.coarse.rows()), 0.0) {
  if (part_.changes) {
    motions_.resize(motion_.size() * block_width);
    block_forces_.resize(motions_.size());
    coarse_sums_.resize(coarse_.size() * block_width);
    coarse_columns_.resize(coarse_sums_.size());
  }
  // Last: where one rank alone has no memory for the factor the others wait in nothing.
  std::vector<Index> groups(coarse_.size());
  for (std::size_t k = 0; k < groups.size(); ++k) {
    groups[k] = static_cast<Index>(k) / part_.motions;
  }
  factor_->factorize(part_.coarse, groups);
  part_.coarse = {};
}

void PartSolver::follow(const BodyChanges& changes) {
  auto next = part_.elements.begin();
  for (std::size_t k = 0; k < changes.elements.size(); ++k) {
    next = std::lower_bound(next, part_.elements.end(), changes.elements[k]);
    if (next == part_.elements.end()) break;
    if (*next != changes.elements[k]) continue;
    const auto own = next - part_.elements.begin();
    part_.axial[own] = changes.axial[k];
    part_.other[own] = changes.other[k];
  }
  if (!changes.ground.empty()) ground_ = changes.ground;
}

GradientsReport PartSolver::search(std::span<const double> right, std::span<double> solution,
                                   double enough, double scale, int most_iterations) {
  return ranks_.conjugate_gradients(
      [&](std::span<const double> q, std::span<double> result) { multiply(q, result); },
      [&](std::span<const double> r, std::span<double> z) { precondition(r, z); }, right, solution,
      enough, scale, most_iterations);
}

GradientsReport PartSolver::search_block(std::span<double> right, std::span<double> solution,
                                         const BlockRow& sizes, double enough,
                                         int most_iterations) {
  // What fails in a map fails in this rank alone, a factor without memory (a SolverError) as well;
  // search() leaves that to Ranks::conjugate_gradients(). Errors of the search are those of all.
  const auto by = [&](auto map) {
    return as_block_map<double>([this, map](std::span<const double> from, std::span<double> to) {
      try {
        (this->*map)(from, to);
      } catch (const std::exception& error) {
        ranks_.abandon(error.what());
      }
    });
  };
  return block_conjugate_gradients<double>(
      by(&PartSolver::multiply_block), by(&PartSolver::precondition_block), right, solution, sizes,
      enough, most_iterations, {}, [&](std::span<double> parts) { ranks_.sum(parts); });
}

/// The own rows of K q: forces on ghosts are the business of their owners.
void PartSolver::multiply(std::span<const double> q, std::span<double> result) {
  const std::vector<Index>& number = part_.unknowns.number;
  for (std::size_t slot = 0; slot < number.size(); ++slot) {
    if (number[slot] >= 0) motion_[slot] = q[number[slot]];
  }
  layer_.update(part_.unknowns.width, {motion_});
  internal_force(part_.network, part_.secants(), motion_, forces_);
  for (std::size_t slot = 0; slot < number.size(); ++slot) {
    if (number[slot] >= 0) result[number[slot]] = forces_.forces[slot];
  }
  for (std::size_t k = 0; k < ground_.size(); ++k) result[k] += ground_[k] * q[k];
}

InternalForce PartSolver::internal(std::span<const double> motion) {
  last_motion_.assign(motion_.size(), 0.0);
  std::copy(motion.begin(), motion.end(), last_motion_.begin());
  layer_.update(part_.unknowns.width, {last_motion_});
  InternalForce others;
  internal_force(part_.network, part_.secants(), last_motion_, part_.others_elements, others);
  internal_force(part_.network, part_.secants(), last_motion_, forces_);
  return {
      {forces_.forces.begin(), forces_.forces.begin() + static_cast<std::ptrdiff_t>(motion.size())},
      forces_.energy - others.energy,
      forces_.support_energy};
}

void PartSolver::multiply_block(std::span<const double> motions, std::span<double> results) {
  std::copy(motions.begin(), motions.end(), motions_.begin());
  layer_.update(part_.unknowns.width * block_width, {motions_});
  block_forces(part_.network, part_.secants(), motions_, block_forces_);
  const std::vector<Index>& number = part_.unknowns.number;
  for (std::size_t slot = 0; slot < part_.rows.size(); ++slot) {
    const std::size_t begin = slot * block_width;
    const double ground = number[slot] >= 0 && !ground_.empty() ? ground_[number[slot]] : 0.0;
    for (std::size_t k = begin; k < begin + block_width; ++k) {
      results[k] = number[slot] >= 0 ? block_forces_[k] + ground * motions[k] : 0.0;
    }
  }
}

void PartSolver::precondition(std::span<const double> residual, std::span<double> result) {
  const Unknowns& unknowns = part_.unknowns;
  const int width = unknowns.width, motions = part_.motions;
  std::fill(coarse_.begin(), coarse_.end(), 0.0);
  const auto for_each_own = [&](auto visit) {
    for (Index p = 0; p < part_.owned(); ++p) {
      double* const box = coarse_.data() + static_cast<std::size_t>(part_.subdomains[p]) * motions;
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

/// The factor wants its right sides one after the other.
void PartSolver::solve_coarse_block() {
  const auto size = static_cast<Eigen::Index>(coarse_.size());
  using Rows = Eigen::Matrix<double, Eigen::Dynamic, block_width, Eigen::RowMajor>;
  using Columns = Eigen::Matrix<double, Eigen::Dynamic, block_width>;
  Eigen::Map<Rows> sums(coarse_sums_.data(), size, block_width);
  Eigen::Map<Columns> columns(coarse_columns_.data(), size, block_width);
  columns = sums;
  factor_->solve_all(coarse_columns_);
  sums = columns;
}

void PartSolver::precondition_block(std::span<const double> residuals, std::span<double> results) {
  const std::size_t width = part_.unknowns.width, slots = part_.rows.size();
  const auto for_each_motion = [&](std::size_t slot, auto visit) {
    const std::size_t box =
        static_cast<std::size_t>(part_.subdomains[slot / width]) * part_.motions;
    for (int m = 0; m < part_.motions; ++m) {
      const double share = part_.rows[slot][m];
      if (share != 0.0) visit(share, coarse_sums_.data() + (box + m) * block_width);
    }
  };
  std::fill(coarse_sums_.begin(), coarse_sums_.end(), 0.0);
  for (std::size_t slot = 0; slot < slots; ++slot) {
    const double* residual = residuals.data() + slot * block_width;
    for_each_motion(slot, [&](double share, double* sums) {
      for (int k = 0; k < block_width; ++k) sums[k] += share * residual[k];
    });
  }
  ranks_.sum(coarse_sums_);
  solve_coarse_block();
  for (std::size_t slot = 0; slot < slots; ++slot) {
    BlockRow sums{};
    const double* block = part_.blocks.data() + slot * width;
    const double* residual = residuals.data() + slot / width * width * block_width;
    for (std::size_t b = 0; b < width; ++b, residual += block_width) {
      for (int k = 0; k < block_width; ++k) sums[k] += block[b] * residual[k];
    }
    for_each_motion(slot, [&](double share, const double* motion) {
      for (int k = 0; k < block_width; ++k) sums[k] += share * motion[k];
    });
    std::copy(sums.begin(), sums.end(), results.begin() + slot * block_width);
  }
}

}  // namespace perilink
