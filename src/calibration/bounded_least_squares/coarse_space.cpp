#include "calibration/bounded_least_squares/coarse_space.hpp"

#include <omp.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <exception>
#include <utility>

#include "base/joined_parts.hpp"
#include "base/side_by_side.hpp"
#include "calibration/bounded_least_squares/equations/variable_parts.hpp"
#include "calibration/bounded_least_squares/killing_fields.hpp"
#include "discretization/point_boxes.hpp"
#include "solver/dense/dense_kernels.hpp"

namespace perilink {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Points per subdomain. More make the modes expensive, fewer make the coarse system expensive.
constexpr Index points_in_plane = 36, points_in_space = 96;

/// Modes belong to the coarse space below this ratio of their stiffness to the stiffness of the
/// points' blocks.
constexpr double soft = 0.003;
/// Least number of subdomains for threads in a correction.
constexpr Index boxes_for_threads = 80;
/// Expected modes per subdomain and equation of a point.
constexpr int expected_fields = 10;

}  // namespace

std::vector<double> point_blocks(const PointEquations& equations, const std::vector<double>& active,
                                 const std::vector<double>& diagonal) {
  const std::size_t rows = static_cast<std::size_t>(equations.rows);
  std::vector<double> blocks(diagonal.size() * rows, 0.0);
  with_rows(equations.rows, [&](auto fixed) {
    constexpr int count = decltype(fixed)::value;
    using Column = Eigen::Matrix<double, count, 1>;
    using Block = Eigen::Matrix<double, count, count>;
    ColumnBlocks<Column> column;
    column.blocks.fill(Column::Zero(equations.rows));
    for (Index v = 0; v < equations.num_variables(); ++v) {
      if (active[v] == 0.0) continue;
      gather_column(equations, v, column);
      for (int k = 0; k < column.count; ++k) {
        const Column scaled = active[v] * column.blocks[k];
        Eigen::Map<Block>(blocks.data() + column.keys[k] * rows * rows, equations.rows,
                          equations.rows)
            .noalias() += scaled * column.blocks[k].transpose();
      }
    }
  });
  finish_blocks(equations.rows, diagonal, blocks);
  return blocks;
}

void invert_blocks(int rows, std::vector<double>& blocks) {
  Eigen::LLT<MatrixXd> factor;
  const std::size_t size = static_cast<std::size_t>(rows) * rows;
  for (std::size_t begin = 0; begin < blocks.size(); begin += size) {
    Eigen::Map<MatrixXd> block(blocks.data() + begin, rows, rows);
    factor.compute(block);
    block.setIdentity();
    factor.solveInPlace(block);
  }
}

void finish_blocks(int size, const std::vector<double>& diagonal, std::vector<double>& blocks) {
  const std::size_t rows = static_cast<std::size_t>(size);
  for (std::size_t p = 0; p < diagonal.size() / rows; ++p) {
    Eigen::Map<MatrixXd> block(blocks.data() + p * rows * rows, size, size);
    // Rows without active variables keep the identity.
    const double floor = 1e-11 * block.trace();
    for (std::size_t r = 0; r < rows; ++r) {
      double& entry = block(static_cast<Eigen::Index>(r), static_cast<Eigen::Index>(r));
      entry += entry > 0.0 ? floor + diagonal[p * rows + r] : 1.0;
    }
  }
}

CoarseSpace::CoarseSpace(const PointEquations& equations, const std::vector<double>& active,
                         const std::vector<double>& diagonal, CoarseModes fields)
    : rows_(equations.rows), threads_(prepare_blas(omp_get_max_threads())) {
  make_boxes(equations, fields);
  find_fields(equations, active, diagonal, fields);
  refactorize(equations, active, diagonal);
}

/// Makes the subdomains. Unconnected parts of a subdomain have separate Killing tensors.
void CoarseSpace::make_boxes(const PointEquations& equations, CoarseModes fields) {
  boxes_ = split_into_boxes(equations.positions, equations.dim,
                            equations.dim == 2 ? points_in_plane : points_in_space);
  box_of_.resize(static_cast<std::size_t>(equations.num_points()));
  place_.resize(box_of_.size());
  number_points();
  if (fields == CoarseModes::soft) return;
  JoinedParts parts(equations.num_points());
  for (Index v = 0; v < equations.num_variables(); ++v) {
    const Index p = equations.first[v], q = equations.second[v];
    if (box_of_[p] == box_of_[q]) parts.join(p, q);
  }
  boxes_ = split_unjoined(boxes_, parts);
  number_points();
}

void CoarseSpace::number_points() {
  for (Index b = 0; b < num_subdomains(); ++b) {
    for (std::size_t k = 0; k < boxes_[b].size(); ++k) {
      box_of_[boxes_[b][k]] = b;
      place_[boxes_[b][k]] = static_cast<Index>(k);
    }
  }
}

/// Returns the variables that act on a single subdomain, per subdomain.
std::vector<std::vector<Index>> CoarseSpace::inner_variables(
    const PointEquations& equations, const std::vector<double>& active) const {
  std::vector<std::vector<Index>> inside(boxes_.size());
  for (Index v = 0; v < equations.num_variables(); ++v) {
    if (active[v] == 0.0) continue;
    const Index box = box_of_[equations.first[v]];
    bool all = true;
    for_each_part(equations, v, [&](Index p, int, int, double) { all = all && box_of_[p] == box; });
    if (all) inside[box].push_back(v);
  }
  return inside;
}

void CoarseSpace::find_fields(const PointEquations& equations, const std::vector<double>& active,
                              const std::vector<double>& diagonal, CoarseModes kind) {
  const bool soft = kind == CoarseModes::soft;
  std::vector<double> blocks;
  std::vector<std::vector<Index>> inside;
  if (soft) {
    blocks = point_blocks(equations, active, diagonal);
    inside = inner_variables(equations, active);
  }
  fields_.resize(boxes_.size());
  for_each_side_by_side(num_subdomains(), threads_, [&](Index b) {
    const MatrixXd fields = soft ? near_null_modes(b, inside[b], equations, active, blocks)
                                 : killing_fields(equations, boxes_[b]);
    fields_[b] = {static_cast<std::size_t>(fields.cols()),
                  {fields.data(), static_cast<std::size_t>(fields.size())}};
  });
  first_field_.assign(boxes_.size() + 1, 0);
  for (Index b = 0; b < num_subdomains(); ++b) {
    first_field_[b + 1] = first_field_[b] + static_cast<Index>(fields_[b].count());
  }
}

/// Returns the near-null-space modes of a subdomain as columns.
/// \param inside  variables that act on no other subdomain
/// \param blocks  per point
MatrixXd CoarseSpace::near_null_modes(Index box, const std::vector<Index>& inside,
                                      const PointEquations& equations,
                                      const std::vector<double>& active,
                                      const std::vector<double>& blocks) const {
  const std::size_t rows = static_cast<std::size_t>(rows_);
  const Eigen::Index size = static_cast<Eigen::Index>(boxes_[box].size()) * rows_;
  MatrixXd matrix = MatrixXd::Zero(size, size);
  with_rows(rows_, [&](auto fixed) {
    constexpr int count = decltype(fixed)::value;
    using Column = Eigen::Matrix<double, count, 1>;
    ColumnBlocks<Column> column;
    column.blocks.fill(Column::Zero(rows_));
    for (const Index v : inside) {
      gather_column(equations, v, column);
      for (int k = 0; k < column.count; ++k) {
        const Column scaled = active[v] * column.blocks[k];
        for (int l = 0; l < column.count; ++l) {
          matrix
              .template block<count, count>(place_[column.keys[k]] * rows_,
                                            place_[column.keys[l]] * rows_, rows_, rows_)
              .noalias() += scaled * column.blocks[l].transpose();
        }
      }
    }
  });
  // The eigenproblem is relative to the blocks of the points.
  std::vector<Eigen::LLT<MatrixXd>> own;
  for (const Index p : boxes_[box]) {
    own.emplace_back(Eigen::Map<const MatrixXd>(blocks.data() + p * rows * rows, rows_, rows_));
  }
  for (std::size_t k = 0; k < own.size(); ++k) {
    auto part = matrix.middleRows(static_cast<Eigen::Index>(k) * rows_, rows_);
    own[k].matrixL().solveInPlace(part);
  }
  for (std::size_t k = 0; k < own.size(); ++k) {
    auto part = matrix.middleCols(static_cast<Eigen::Index>(k) * rows_, rows_);
    own[k].matrixU().solveInPlace<Eigen::OnTheRight>(part);
  }
  MatrixXd vectors = eigenvectors_below(matrix, soft, expected_fields * rows_);
  for (std::size_t k = 0; k < own.size(); ++k) {
    auto part = vectors.middleRows(static_cast<Eigen::Index>(k) * rows_, rows_);
    own[k].matrixU().solveInPlace(part);
  }
  return vectors;
}

/// Sorts variables by the subdomains on which they act, and finds the blocks of the coarse system.
/// Another problem may have fewer variables.
void CoarseSpace::sort_variables(const PointEquations& equations) {
  if (first_ == equations.first && second_ == equations.second) return;
  first_ = equations.first;
  second_ = equations.second;
  order_.clear();
  order_.reserve(equations.first.size());
  groups_.clear();
  pairs_.clear();
  for (Index b = 0; b < num_subdomains(); ++b) pairs_.emplace_back(b, b);
  for (Index v = 0; v < equations.num_variables(); ++v) {
    Key key;
    int count = 0;
    key.fill(no_index);
    for_each_part(equations, v, [&](Index p, int, int, double) {
      const Index box = box_of_[p];
      int k = 0;
      while (k < count && key[k] < box) ++k;
      if (k < count && key[k] == box) return;
      for (int last = count++; last > k; --last) key[last] = key[last - 1];
      key[k] = box;
    });
    order_.emplace_back(key, v);
  }
  std::sort(order_.begin(), order_.end());
  for (std::size_t n = 0; n < order_.size(); ++n) {
    const Key& key = order_[n].first;
    if (n == 0 || key != order_[n - 1].first) groups_.push_back(n);
    if (groups_.back() != n) continue;
    for (int k = 0; k < 4 && key[k] != no_index; ++k) {
      for (int l = 0; l < k; ++l) pairs_.emplace_back(key[l], key[k]);
    }
  }
  groups_.push_back(order_.size());
  std::sort(pairs_.begin(), pairs_.end());
  pairs_.erase(std::unique(pairs_.begin(), pairs_.end()), pairs_.end());
}

/// Adds the diagonal of the system to the diagonal block of a subdomain.
void CoarseSpace::add_diagonal(Index box, const std::vector<double>& diagonal,
                               MatrixXd& own) const {
  const std::vector<double> values = fields_[box].values();
  const Eigen::Index count = own.rows();
  const Eigen::Map<const MatrixXd> fields(
      values.data(), count,
      static_cast<Eigen::Index>(values.size()) / std::max<Eigen::Index>(count, 1));
  MatrixXd weighted = fields;
  for (std::size_t k = 0; k < boxes_[box].size(); ++k) {
    for (int r = 0; r < rows_; ++r) {
      weighted.col(static_cast<Eigen::Index>(k) * rows_ + r) *=
          diagonal[boxes_[box][k] * static_cast<std::size_t>(rows_) + static_cast<std::size_t>(r)];
    }
  }
  add_product(weighted, MatrixXd(fields), own);
}

/// Computes the blocks of a group of variables, by pairs of its subdomains.
auto CoarseSpace::products(std::size_t group, const PointEquations& equations,
                           const std::vector<double>& active) const -> GroupProducts {
  constexpr std::size_t most = 256;
  const std::size_t rows = static_cast<std::size_t>(rows_);
  const Key& key = order_[groups_[group]].first;
  int count = 0;
  while (count < 4 && key[count] != no_index) ++count;
  GroupProducts sums;
  for (int k = 0; k < count; ++k) {
    for (int l = 0; l <= k; ++l) {
      sums[k][l] = MatrixXd::Zero(num_fields(key[k]), num_fields(key[l]));
    }
  }
  std::array<MatrixXd, 4> work;
  ColumnBlocks<VectorXd> column;
  column.blocks.fill(VectorXd::Zero(rows_));
  const std::size_t last = groups_[group + 1];
  for (std::size_t begin = groups_[group], end; begin < last; begin = end) {
    end = std::min(last, begin + most);
    for (int k = 0; k < count; ++k) work[k].setZero(num_fields(key[k]), end - begin);
    for (std::size_t n = begin; n < end; ++n) {
      const Index v = order_[n].second;
      if (active[v] == 0.0) continue;
      const double root = std::sqrt(active[v]);
      gather_column(equations, v, column);
      for (int c = 0; c < column.count; ++c) {
        const Index p = column.keys[c];
        const int k =
            static_cast<int>(std::find(key.begin(), key.begin() + count, box_of_[p]) - key.begin());
        column.blocks[c] *= root;
        fields_[box_of_[p]].add_sums(static_cast<std::size_t>(place_[p] * rows_),
                                     {column.blocks[c].data(), rows},
                                     work[k].col(static_cast<Eigen::Index>(n - begin)).data());
      }
    }
    for (int k = 0; k < count; ++k) {
      for (int l = 0; l <= k; ++l) add_product(work[k], work[l], sums[k][l]);
    }
  }
  return sums;
}

/// Adds the blocks of variables between the subdomains of the key. Adds them also to the interior
/// of an aggregate that contains all these subdomains.
void CoarseSpace::add(const Key& key, const GroupProducts& sums, SubdomainMatrix& matrix,
                      SubdomainMatrix* inside) {
  for (int k = 0; k < 4 && key[k] != no_index; ++k) {
    if (CoarseSystem::large_box(key[k]) != CoarseSystem::large_box(key[0])) inside = nullptr;
  }
  for (int k = 0; k < 4; ++k) {
    for (int l = 0; l <= k; ++l) {
      if (sums[k][l].size() == 0) continue;
      matrix.block(key[l], key[k]) += sums[k][l];
      if (inside != nullptr) inside->block(key[l], key[k]) += sums[k][l];
    }
  }
}

void CoarseSpace::refactorize(const PointEquations& equations, const std::vector<double>& active,
                              const std::vector<double>& diagonal) {
  if (num_fields() == 0) return;
  sort_variables(equations);
  SubdomainMatrix matrix{first_field_, pairs_, {}}, inside{first_field_, pairs_, {}};
  for (const auto& [a, b] : pairs_) {
    matrix.blocks.push_back(MatrixXd::Zero(num_fields(b), num_fields(a)));
  }
  // Blocks inside aggregates are needed only once.
  const bool parts = CoarseSystem::is_nested(num_subdomains()) && !coarse_.has_fields();
  for (const auto& [a, b] : pairs_) {
    const bool joined = parts && CoarseSystem::large_box(a) == CoarseSystem::large_box(b);
    inside.blocks.push_back(joined ? MatrixXd::Zero(num_fields(b), num_fields(a)) : MatrixXd());
  }
  for (Index b = 0; b < num_subdomains(); ++b) add_diagonal(b, diagonal, matrix.block(b, b));
  const Index num_groups = static_cast<Index>(groups_.size()) - 1;
  std::exception_ptr error;
  // Sums have the order of the groups for any number of threads.
#pragma omp parallel for ordered schedule(dynamic) num_threads(threads_)
  for (Index g = 0; g < num_groups; ++g) {
    GroupProducts sums;
    try {
      sums = products(static_cast<std::size_t>(g), equations, active);
    } catch (...) {
#pragma omp critical
      error = std::current_exception();
    }
#pragma omp ordered
    add(order_[groups_[g]].first, sums, matrix, parts ? &inside : nullptr);
  }
  if (error) std::rethrow_exception(error);
  coarse_.factorize(matrix, inside);
}

void CoarseSpace::add_correction(const double* residual, double* result) const {
  if (num_fields() == 0) return;
  const std::size_t rows = static_cast<std::size_t>(rows_);
  std::vector<double> coarse(static_cast<std::size_t>(num_fields()), 0.0);
#pragma omp parallel for schedule(static) if (num_subdomains() > boxes_for_threads)
  for (Index b = 0; b < num_subdomains(); ++b) {
    for (std::size_t k = 0; k < boxes_[b].size(); ++k) {
      fields_[b].add_sums(k * rows,
                          {residual + static_cast<std::size_t>(boxes_[b][k]) * rows, rows},
                          coarse.data() + first_field_[b]);
    }
  }
  coarse_.solve(coarse);
#pragma omp parallel for schedule(static) if (num_subdomains() > boxes_for_threads)
  for (Index b = 0; b < num_subdomains(); ++b) {
    std::vector<double> local(boxes_[b].size() * rows, 0.0);
    fields_[b].add_fields({coarse.data() + first_field_[b], coarse.data() + first_field_[b + 1]},
                          local.data());
    for (std::size_t k = 0; k < local.size(); ++k) {
      result[static_cast<std::size_t>(boxes_[b][k / rows]) * rows + k % rows] += local[k];
    }
  }
}

}  // namespace perilink
