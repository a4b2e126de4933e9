#include "analysis/quasistatic/ranks/part_solver.hpp"

#include <algorithm>
#include <exception>
#include <utility>

#include "assembly/block_forces.hpp"
#include "solver/conjugate_gradients.hpp"
#include "solver/factor_routes.hpp"

namespace perilink {
namespace {

void put_matrix(const SparseMatrix& matrix, Parcel& parcel) {
  std::vector<Index> rows, columns;
  std::vector<double> values;
  for (Index column = 0; column < static_cast<Index>(matrix.outerSize()); ++column) {
    for (SparseMatrix::InnerIterator entry(matrix, column); entry; ++entry) {
      rows.push_back(static_cast<Index>(entry.row()));
      columns.push_back(column);
      values.push_back(entry.value());
    }
  }
  parcel.put(matrix.rows());
  parcel.put(rows);
  parcel.put(columns);
  parcel.put(values);
}

SparseMatrix get_matrix(Parcel& parcel) {
  SparseMatrix matrix;
  const auto size = parcel.get<decltype(matrix.rows())>();
  std::vector<Index> rows, columns;
  std::vector<double> values;
  parcel.get(rows);
  parcel.get(columns);
  parcel.get(values);
  std::vector<Eigen::Triplet<double, Index>> entries;
  entries.reserve(values.size());
  for (std::size_t k = 0; k < values.size(); ++k) {
    entries.emplace_back(rows[k], columns[k], values[k]);
  }
  matrix.resize(size, size);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

template <class Changes, class Visit>
void for_each_change(Changes& changes, Visit visit) {
  visit(changes.elements);
  visit(changes.axial);
  visit(changes.other);
  visit(changes.ground);
}

template <class Part, class Visit>
void for_each_row(Part& part, Visit visit) {
  visit(part.axial);
  visit(part.other);
  visit(part.blocks);
  visit(part.subdomains);
  visit(part.rows);
  visit(part.motions);
  visit(part.changes);
}

/// Numbers the unknowns of the own particles from zero, and removes the numbers of ghosts. Numbers
/// rise with particles.
void renumber(BodyPart& part) {
  Unknowns& unknowns = part.body.unknowns;
  const auto begin = unknowns.number.begin() + std::ptrdiff_t{part.own_begin} * unknowns.width;
  const auto end = unknowns.number.begin() + std::ptrdiff_t{part.own_end} * unknowns.width;
  std::fill(unknowns.number.begin(), begin, no_index);
  std::fill(end, unknowns.number.end(), no_index);
  for (auto number = begin; number != end; ++number) {
    if (*number >= 0) *number = unknowns.count++;
  }
}

}  // namespace

void BodyChanges::pack(Parcel& parcel) const {
  for_each_change(*this, [&](const auto& member) { parcel.put(member); });
}

BodyChanges BodyChanges::unpack(Parcel& parcel) {
  BodyChanges changes;
  for_each_change(changes, [&](auto& member) { parcel.get(member); });
  return changes;
}

void PreconditionedPart::pack(Parcel& parcel) const {
  part.pack(parcel);
  for_each_row(*this, [&](const auto& member) { parcel.put(member); });
  put_matrix(coarse, parcel);
}

PreconditionedPart PreconditionedPart::unpack(Parcel& parcel) {
  PreconditionedPart own;
  own.part = BodyPart::unpack(parcel);
  for_each_row(own, [&](auto& member) { parcel.get(member); });
  own.coarse = get_matrix(parcel);
  return own;
}

PreconditionedPart cut_part(const Network& network, Secants secants, const Unknowns& unknowns,
                            const SubdomainMotions& motions, const SubdomainStiffness& stiffness,
                            const Partition& partition, int rank) {
  PreconditionedPart own;
  own.part = cut_part(network, unknowns, partition, rank);
  renumber(own.part);
  for (const Index e : own.part.elements) {
    own.axial.push_back(secants.axial(e));
    own.other.push_back(secants[e]);
  }
  const int width = unknowns.width;
  const Index begin = partition.own_begin(rank), end = partition.own_end(rank);
  own.blocks = slice(stiffness.blocks, begin, end, width * width);
  for (Index p = begin; p < end; ++p) {
    own.subdomains.push_back(motions.subdomain_of(p));
    for (int a = 0; a < width; ++a) own.rows.push_back(motions.row(p, a));
  }
  own.coarse = stiffness.coarse;
  own.motions = motions.num_motions();
  return own;
}

PartSolver::PartSolver(Ranks& ranks, PreconditionedPart part)
    : ranks_(ranks),
      own_(std::move(part)),
      factor_(make_factor(own_.changes ? FactorRoute::refactorize : FactorRoute::in_place, 1)),
      layer_(ranks, own_.part.ghosts),
      motion_(unknowns().number.size(), 0.0),
      coarse_(static_cast<std::size_t>(own_.coarse.rows()), 0.0) {
  if (own_.changes) {
    motions_.resize(motion_.size() * block_width);
    block_forces_.resize(motions_.size());
    coarse_sums_.resize(coarse_.size() * block_width);
    coarse_columns_.resize(coarse_sums_.size());
  }
  // Last, after all collective calls: a rank without memory for the factor then leaves no rank
  // waiting.
  std::vector<Index> groups(coarse_.size());
  for (std::size_t k = 0; k < groups.size(); ++k) {
    groups[k] = static_cast<Index>(k) / own_.motions;
  }
  factor_->factorize(own_.coarse, groups);
  own_.coarse = {};
}

void PartSolver::follow(const BodyChanges& changes) {
  const std::vector<Index>& elements = own_.part.elements;
  auto next = elements.begin();
  for (std::size_t k = 0; k < changes.elements.size(); ++k) {
    next = std::lower_bound(next, elements.end(), changes.elements[k]);
    if (next == elements.end()) break;
    if (*next != changes.elements[k]) continue;
    const auto own = next - elements.begin();
    own_.axial[own] = changes.axial[k];
    own_.other[own] = changes.other[k];
  }
  if (!changes.ground.empty()) ground_ = changes.ground;
}

template <class Map>
auto PartSolver::guarded(Map map) {
  return [this, map](std::span<const double> from, std::span<double> to) {
    try {
      (this->*map)(from, to);
    } catch (const std::exception& error) {
      ranks_.abandon(error.what());
    }
  };
}

GradientsReport PartSolver::search(std::span<const double> right, std::span<double> solution,
                                   double enough, double scale, int most_iterations) {
  const auto dot = [this](std::span<const double> a, std::span<const double> b) {
    double sum = scalar_product(a, b);
    ranks_.sum({&sum, 1});
    return sum;
  };
  return conjugate_gradients(guarded(&PartSolver::multiply), guarded(&PartSolver::precondition),
                             right, solution, enough, scale, most_iterations, dot);
}

GradientsReport PartSolver::search_block(std::span<double> right, std::span<double> solution,
                                         const BlockRow& sizes, double enough,
                                         int most_iterations) {
  return block_conjugate_gradients<double>(
      as_block_map<double>(guarded(&PartSolver::multiply_block)),
      as_block_map<double>(guarded(&PartSolver::precondition_block)), right, solution, sizes,
      enough, most_iterations, {}, [&](std::span<double> parts) { ranks_.sum(parts); });
}

/// Finds the own rows of K q; the owners of ghosts find the forces on them.
void PartSolver::multiply(std::span<const double> q, std::span<double> result) {
  const std::vector<Index>& number = unknowns().number;
  for (std::size_t slot = 0; slot < number.size(); ++slot) {
    if (number[slot] >= 0) motion_[slot] = q[number[slot]];
  }
  layer_.update(unknowns().width, {motion_});
  internal_force(own_.part.body.network, own_.secants(), motion_, forces_);
  for (std::size_t slot = 0; slot < number.size(); ++slot) {
    if (number[slot] >= 0) result[number[slot]] = forces_.forces[slot];
  }
  for (std::size_t k = 0; k < ground_.size(); ++k) result[k] += ground_[k] * q[k];
}

void PartSolver::multiply_block(std::span<const double> motions, std::span<double> results) {
  const std::size_t first = first_slot();
  std::copy(motions.begin(), motions.end(),
            motions_.begin() + static_cast<std::ptrdiff_t>(first * block_width));
  layer_.update(unknowns().width * block_width, {motions_});
  block_forces(own_.part.body.network, own_.secants(), motions_, block_forces_);
  for (std::size_t slot = 0; slot < own_.rows.size(); ++slot) {
    const Index number = unknowns().number[first + slot];
    const double ground = number >= 0 && !ground_.empty() ? ground_[number] : 0.0;
    const double* const force = block_forces_.data() + (first + slot) * block_width;
    for (std::size_t c = 0; c < block_width; ++c) {
      const std::size_t k = slot * block_width + c;
      results[k] = number >= 0 ? force[c] + ground * motions[k] : 0.0;
    }
  }
}

void PartSolver::precondition(std::span<const double> residual, std::span<double> result) {
  const int width = unknowns().width, motions = own_.motions;
  const std::span<const Index> number = std::span(unknowns().number).subspan(first_slot());
  std::fill(coarse_.begin(), coarse_.end(), 0.0);
  const auto for_each_own = [&](auto visit) {
    for (std::size_t slot = 0; slot < own_.rows.size(); ++slot) {
      if (number[slot] < 0) continue;
      const std::size_t box = own_.subdomains[slot / width];
      visit(slot, coarse_.data() + box * motions);
    }
  };
  for_each_own([&](std::size_t slot, double* box) {
    for (int m = 0; m < motions; ++m) box[m] += own_.rows[slot][m] * residual[number[slot]];
  });
  ranks_.sum(coarse_);
  factor_->solve(coarse_, coarse_);
  for_each_own([&](std::size_t slot, const double* box) {
    const double* block = own_.blocks.data() + slot * width;
    const std::span<const Index> around = number.subspan(slot / width * width, width);
    double sum = 0.0;
    for (int b = 0; b < width; ++b) {
      if (around[b] >= 0) sum += block[b] * residual[around[b]];
    }
    for (int m = 0; m < motions; ++m) sum += own_.rows[slot][m] * box[m];
    result[number[slot]] = sum;
  });
}

/// The factor takes its right sides column by column.
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
  const std::size_t width = unknowns().width, slots = own_.rows.size();
  const auto for_each_motion = [&](std::size_t slot, auto visit) {
    const std::size_t box = static_cast<std::size_t>(own_.subdomains[slot / width]) * own_.motions;
    for (int m = 0; m < own_.motions; ++m) {
      const double share = own_.rows[slot][m];
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
    const double* block = own_.blocks.data() + slot * width;
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
