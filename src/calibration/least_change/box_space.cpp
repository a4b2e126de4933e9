#include "calibration/least_change/box_space.hpp"

#include <omp.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <exception>
#include <utility>

#include "calibration/least_change/variable_parts.hpp"
#include "discretization/point_boxes.hpp"
#include "solver/dense_kernels.hpp"
#include "solver/factor_routes.hpp"

namespace perilink {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Points of a box. More make the fields dear, fewer the coarse system.
constexpr Index points_in_plane = 36, points_in_space = 96;

/// Fields whose stiffness over that of the points' own blocks is below this are left to the coarse
/// system.
constexpr double soft = 0.003;
/// About so many of each box for each equation of a point.
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
  for (std::size_t p = 0; p < diagonal.size() / rows; ++p) {
    Eigen::Map<MatrixXd> block(blocks.data() + p * rows * rows, equations.rows, equations.rows);
    // What no variable between the bounds acts on keeps the identity.
    const double floor = 1e-11 * block.trace();
    for (std::size_t r = 0; r < rows; ++r) {
      double& entry = block(static_cast<Eigen::Index>(r), static_cast<Eigen::Index>(r));
      entry += entry > 0.0 ? floor + diagonal[p * rows + r] : 1.0;
    }
  }
  return blocks;
}

BoxSpace::BoxSpace(const PointEquations& equations, const std::vector<double>& active,
                   const std::vector<double>& diagonal)
    : rows_(equations.rows), threads_(prepare_blas(omp_get_max_threads())) {
  make_boxes(equations);
  find_fields(equations, active, diagonal);
  refactorize(equations, active, diagonal);
}

void BoxSpace::make_boxes(const PointEquations& equations) {
  boxes_ = split_into_boxes(equations.positions, equations.dim,
                            equations.dim == 2 ? points_in_plane : points_in_space);
  box_of_.resize(static_cast<std::size_t>(equations.num_points()));
  place_.resize(box_of_.size());
  for (Index b = 0; b < num_boxes(); ++b) {
    for (std::size_t k = 0; k < boxes_[b].size(); ++k) {
      box_of_[boxes_[b][k]] = b;
      place_[boxes_[b][k]] = static_cast<Index>(k);
    }
  }
}

void BoxSpace::find_fields(const PointEquations& equations, const std::vector<double>& active,
                           const std::vector<double>& diagonal) {
  const std::vector<double> blocks = point_blocks(equations, active, diagonal);
  std::vector<std::vector<Index>> inside(boxes_.size());  // variables
  for (Index v = 0; v < equations.num_variables(); ++v) {
    if (active[v] == 0.0) continue;
    const Index box = box_of_[equations.first[v]];
    bool all = true;
    for_each_part(equations, v, [&](Index p, int, int, double) { all = all && box_of_[p] == box; });
    if (all) inside[box].push_back(v);
  }
  fields_.resize(boxes_.size());
  std::exception_ptr error;
#pragma omp parallel for schedule(dynamic) num_threads(threads_)
  for (Index b = 0; b < num_boxes(); ++b) {
    try {
      fields_[b] = soft_fields(b, inside[b], equations, active, blocks);
    } catch (...) {
#pragma omp critical
      error = std::current_exception();
    }
  }
  if (error) std::rethrow_exception(error);
  first_field_.assign(boxes_.size() + 1, 0);
  for (Index b = 0; b < num_boxes(); ++b) {
    first_field_[b + 1] = first_field_[b] + static_cast<Index>(fields_[b].rows());
  }
}

/// Those of one box, as rows.
/// \param inside  variables that act on no other box
/// \param blocks  per point
MatrixXd BoxSpace::soft_fields(Index box, const std::vector<Index>& inside,
                               const PointEquations& equations, const std::vector<double>& active,
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
  // Relative to the blocks of the points.
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
  return vectors.transpose();
}

/// The variables by the boxes on which they act, and the blocks of the coarse system that these
/// fill. Those of another search may be fewer.
void BoxSpace::sort_variables(const PointEquations& equations) {
  if (first_ == equations.first && second_ == equations.second) return;
  first_ = equations.first;
  second_ = equations.second;
  order_.clear();
  groups_.clear();
  pairs_.clear();
  factor_.reset();
  for (Index b = 0; b < num_boxes(); ++b) pairs_.emplace_back(b, b);
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

/// Adds what the diagonal of the system gives to a box's own block.
void BoxSpace::add_diagonal(Index box, const std::vector<double>& diagonal, MatrixXd& own) const {
  MatrixXd weighted = fields_[box];
  for (std::size_t k = 0; k < boxes_[box].size(); ++k) {
    for (int r = 0; r < rows_; ++r) {
      weighted.col(static_cast<Eigen::Index>(k) * rows_ + r) *=
          diagonal[boxes_[box][k] * static_cast<std::size_t>(rows_) + static_cast<std::size_t>(r)];
    }
  }
  add_product(weighted, fields_[box], own);
}

/// What the variables of a group give to the blocks of its boxes, by pairs of these.
auto BoxSpace::products(std::size_t group, const PointEquations& equations,
                        const std::vector<double>& active) const -> GroupProducts {
  constexpr std::size_t most = 256;
  const Key& key = order_[groups_[group]].first;
  int count = 0;
  while (count < 4 && key[count] != no_index) ++count;
  GroupProducts sums;
  for (int k = 0; k < count; ++k) {
    for (int l = 0; l <= k; ++l) {
      sums[k][l] = MatrixXd::Zero(fields_[key[k]].rows(), fields_[key[l]].rows());
    }
  }
  std::array<MatrixXd, 4> work;
  ColumnBlocks<VectorXd> column;
  column.blocks.fill(VectorXd::Zero(rows_));
  const std::size_t last = groups_[group + 1];
  for (std::size_t begin = groups_[group], end; begin < last; begin = end) {
    end = std::min(last, begin + most);
    for (int k = 0; k < count; ++k) work[k].setZero(fields_[key[k]].rows(), end - begin);
    for (std::size_t n = begin; n < end; ++n) {
      const Index v = order_[n].second;
      if (active[v] == 0.0) continue;
      const double root = std::sqrt(active[v]);
      gather_column(equations, v, column);
      for (int c = 0; c < column.count; ++c) {
        const Index p = column.keys[c];
        const int k =
            static_cast<int>(std::find(key.begin(), key.begin() + count, box_of_[p]) - key.begin());
        work[k].col(static_cast<Eigen::Index>(n - begin)).noalias() +=
            fields_[box_of_[p]].middleCols(place_[p] * rows_, rows_) * (root * column.blocks[c]);
      }
    }
    for (int k = 0; k < count; ++k) {
      for (int l = 0; l <= k; ++l) add_product(work[k], work[l], sums[k][l]);
    }
  }
  return sums;
}

void BoxSpace::refactorize(const PointEquations& equations, const std::vector<double>& active,
                           const std::vector<double>& diagonal) {
  if (num_fields() == 0) return;
  sort_variables(equations);
  std::vector<MatrixXd> blocks;
  for (const auto& [a, b] : pairs_) {
    blocks.push_back(MatrixXd::Zero(fields_[b].rows(), fields_[a].rows()));
    if (a == b) add_diagonal(b, diagonal, blocks.back());
  }
  const Index num_groups = static_cast<Index>(groups_.size()) - 1;
  std::exception_ptr error;
  // Sums in the order of the groups, whichever thread makes them.
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
    for (int k = 0; k < 4; ++k) {
      for (int l = 0; l <= k; ++l) {
        if (sums[k][l].size() == 0) continue;
        const Key& key = order_[groups_[g]].first;
        blocks[static_cast<std::size_t>(
            std::lower_bound(pairs_.begin(), pairs_.end(), std::pair(key[l], key[k])) -
            pairs_.begin())] += sums[k][l];
      }
    }
  }
  if (error) std::rethrow_exception(error);
  factorize(blocks);
}

/// \param blocks  those of the coarse system, by pairs_
void BoxSpace::factorize(const std::vector<MatrixXd>& blocks) {
  SparseMatrix coarse(num_fields(), num_fields());
  Index size = 0;
  for (const MatrixXd& block : blocks) size += static_cast<Index>(block.size());
  coarse.resizeNonZeros(size);
  std::vector<Index> group;
  Index next = 0;
  for (std::size_t first = 0, last; first < pairs_.size(); first = last) {
    const Index box = pairs_[first].first;
    for (last = first; last < pairs_.size() && pairs_[last].first == box;) ++last;
    for (Eigen::Index c = 0; c < fields_[box].rows(); ++c) {
      coarse.outerIndexPtr()[group.size()] = next;
      group.push_back(box);
      for (std::size_t n = first; n < last; ++n) {
        for (Eigen::Index r = n == first ? c : 0; r < blocks[n].rows(); ++r, ++next) {
          double value = blocks[n](r, c);
          if (n == first && r == c) value = value > 0.0 ? (1.0 + 1e-13) * value : 1.0;
          coarse.innerIndexPtr()[next] = first_field_[pairs_[n].second] + static_cast<Index>(r);
          coarse.valuePtr()[next] = value;
        }
      }
    }
  }
  coarse.outerIndexPtr()[num_fields()] = next;
  coarse.resizeNonZeros(next);
  if (factor_) return factor_->refactorize(coarse);
  factor_ = make_factor(FactorRoute::in_place, 1);  // threads wait longer than they work
  factor_->factorize(coarse, group);
}

void BoxSpace::add_correction(const double* residual, double* result) const {
  if (num_fields() == 0) return;
  VectorXd coarse(num_fields()), local;
  const auto at = [](auto* values, Index point, int rows) {
    return Eigen::Map<std::conditional_t<std::is_const_v<std::remove_pointer_t<decltype(values)>>,
                                         const VectorXd, VectorXd>>(
        values + static_cast<std::size_t>(point) * static_cast<std::size_t>(rows), rows);
  };
  for (Index b = 0; b < num_boxes(); ++b) {
    local.resize(fields_[b].cols());
    for (std::size_t k = 0; k < boxes_[b].size(); ++k) {
      local.segment(static_cast<Eigen::Index>(k) * rows_, rows_) =
          at(residual, boxes_[b][k], rows_);
    }
    coarse.segment(first_field_[b], fields_[b].rows()).noalias() = fields_[b] * local;
  }
  const std::size_t size = static_cast<std::size_t>(coarse.size());
  factor_->solve({coarse.data(), size}, {coarse.data(), size});
  for (Index b = 0; b < num_boxes(); ++b) {
    local.noalias() = fields_[b].transpose() * coarse.segment(first_field_[b], fields_[b].rows());
    for (std::size_t k = 0; k < boxes_[b].size(); ++k) {
      at(result, boxes_[b][k], rows_) += local.segment(static_cast<Eigen::Index>(k) * rows_, rows_);
    }
  }
}

}  // namespace perilink
