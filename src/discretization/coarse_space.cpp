#include "discretization/coarse_space.hpp"

#include <omp.h>

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <utility>

#include "discretization/variable_parts.hpp"

namespace perilink {
namespace {

/// Points along the side of a box: fewer make the coarse system dear, more leave work to the
/// iteration.
constexpr double points_along_box = 8.0;

/// Added to the diagonal, relative to its mean, for what has no stiffness at all.
constexpr double tiny = 1e-12;

}  // namespace

CoarseSpace::CoarseSpace(const PointEquations& equations, const std::vector<double>& active,
                         const std::vector<double>& shifts, const std::vector<double>& compliance,
                         Boxes boxes)
    : dim_(equations.dim), rows_(equations.rows) {
  if (boxes == Boxes::of_many_points) {
    functions_ = 1 + dim_;
    number_boxes(equations);
  } else {
    put_points_in_boxes_of_their_own(equations);
  }
  assemble(equations, active, shifts, compliance);
}

void CoarseSpace::put_points_in_boxes_of_their_own(const PointEquations& equations) {
  num_boxes_ = equations.num_points();
  box_of_.resize(static_cast<std::size_t>(num_boxes_));
  std::iota(box_of_.begin(), box_of_.end(), 0);
  values_.assign(box_of_.size(), 1.0);
}

/// Boxes of equal size; those without points get no number.
void CoarseSpace::number_boxes(const PointEquations& equations) {
  const Index count = equations.num_points();
  Vector3 lower{}, upper{};
  for (Index p = 0; p < count; ++p) {
    for (int a = 0; a < dim_; ++a) {
      const double x = equations.positions[static_cast<std::size_t>(p) * dim_ + a];
      lower[a] = p == 0 ? x : std::min(lower[a], x);
      upper[a] = p == 0 ? x : std::max(upper[a], x);
    }
  }
  double extent = 1.0;
  for (int a = 0; a < dim_; ++a) extent *= upper[a] - lower[a];
  const double side = points_along_box * std::pow(extent / std::max<Index>(count, 1), 1.0 / dim_);
  std::map<std::array<Index, 3>, Index> numbers;
  box_of_.resize(static_cast<std::size_t>(count));
  values_.resize(static_cast<std::size_t>(count) * functions_);
  for (Index p = 0; p < count; ++p) {
    std::array<Index, 3> box{};
    for (int a = 0; a < dim_; ++a) {
      const double place =
          (equations.positions[static_cast<std::size_t>(p) * dim_ + a] - lower[a]) / side;
      box[a] = static_cast<Index>(place);
      values_[static_cast<std::size_t>(p) * functions_ + 1 + a] = 2.0 * (place - box[a]) - 1.0;
    }
    values_[static_cast<std::size_t>(p) * functions_] = 1.0;
    box_of_[p] = numbers.emplace(box, static_cast<Index>(numbers.size())).first->second;
  }
  num_boxes_ = static_cast<Index>(numbers.size());
}

/// Adds P' compliance P. \param block  of a pair of boxes
template <class BlockOf>
void CoarseSpace::add_compliance(const std::vector<double>& compliance, BlockOf block) const {
  for (std::size_t p = 0; !compliance.empty() && p < box_of_.size(); ++p) {
    Eigen::MatrixXd& matrix = block(box_of_[p], box_of_[p]);
    const double* value = values_.data() + p * static_cast<std::size_t>(functions_);
    for (int r = 0; r < rows_; ++r) {
      const double part = compliance[p * static_cast<std::size_t>(rows_) + r];
      for (int f = 0; f < functions_; ++f) {
        for (int g = 0; g < functions_; ++g) {
          matrix(r * functions_ + f, r * functions_ + g) += part * value[f] * value[g];
        }
      }
    }
  }
}

void CoarseSpace::assemble(const PointEquations& equations, const std::vector<double>& active,
                           const std::vector<double>& shifts,
                           const std::vector<double>& compliance) {
  const int width = rows_ * functions_;
  std::map<std::pair<Index, Index>, Eigen::MatrixXd> blocks;
  const auto block = [&](Index a, Index b) -> Eigen::MatrixXd& {
    Eigen::MatrixXd& found = blocks[{a, b}];
    if (found.size() == 0) found = Eigen::MatrixXd::Zero(width, width);
    return found;
  };
  for (Index box = 0; box < num_boxes_; ++box) block(box, box);  // also of those without variables
  ColumnBlocks<Eigen::VectorXd> column;
  column.blocks.fill(Eigen::VectorXd::Zero(width));
  for (Index v = 0; v < equations.num_variables(); ++v) {
    if (active[v] == 0.0) continue;
    column.count = 0;
    const double* a = equations.coefficients.data() + static_cast<std::size_t>(v) * rows_;
    for_each_part(equations, v, [&](Index p, int from, int to, double sign) {
      Eigen::VectorXd& part = column.of(box_of_[p]);
      for (int r = from; r < to; ++r) {
        const double value = sign * a[r] * equations.scale[static_cast<std::size_t>(p) * rows_ + r];
        for (int f = 0; f < functions_; ++f) {
          part[r * functions_ + f] += value * values_[static_cast<std::size_t>(p) * functions_ + f];
        }
      }
    });
    for (int k = 0; k < column.count; ++k) {
      for (int l = 0; l < column.count; ++l) {
        if (column.keys[k] < column.keys[l]) continue;
        block(column.keys[k], column.keys[l]).noalias() +=
            active[v] * column.blocks[k] * column.blocks[l].transpose();
      }
    }
  }
  add_compliance(compliance, block);
  const double points_in_box = static_cast<double>(box_of_.size()) / num_boxes_;
  // The shifts of the fine system, and a little more where constants and rigid modes have no
  // stiffness.
  std::vector<Eigen::Triplet<double>> entries;
  for (auto& [place, matrix] : blocks) {
    if (place.first == place.second) {
      const double floor = tiny * matrix.trace() / width;
      for (int k = 0; k < width; ++k) {
        const double shift = floor + shifts[k / functions_] * points_in_box;
        matrix(k, k) += matrix(k, k) > 0.0 ? shift : 1.0;
      }
    }
    for (int c = 0; c < width; ++c) {
      for (int r = 0; r < width; ++r) {
        if (place.first == place.second && r < c) continue;
        entries.emplace_back(place.first * width + r, place.second * width + c, matrix(r, c));
      }
    }
  }
  factorize(entries);
}

void CoarseSpace::factorize(const std::vector<Eigen::Triplet<double>>& entries) {
  const int width = rows_ * functions_;
  SparseMatrix matrix(static_cast<Eigen::Index>(num_boxes_) * width,
                      static_cast<Eigen::Index>(num_boxes_) * width);
  matrix.setFromTriplets(entries.begin(), entries.end());
  std::vector<Index> box_of_unknown(static_cast<std::size_t>(num_boxes_) * width);
  for (std::size_t k = 0; k < box_of_unknown.size(); ++k) {
    box_of_unknown[k] = static_cast<Index>(k / static_cast<std::size_t>(width));
  }
  factor_ = make_factor(FactorRoute::in_place, omp_get_max_threads());
  factor_->factorize(matrix, box_of_unknown);
}

void CoarseSpace::add_correction(const double* residual, double* result) const {
  const int width = rows_ * functions_;
  std::vector<double> coarse(static_cast<std::size_t>(num_boxes_) * width, 0.0);
  for (std::size_t p = 0; p < box_of_.size(); ++p) {
    double* block = coarse.data() + static_cast<std::size_t>(box_of_[p]) * width;
    for (int r = 0; r < rows_; ++r) {
      for (int f = 0; f < functions_; ++f) {
        block[r * functions_ + f] += residual[p * rows_ + r] * values_[p * functions_ + f];
      }
    }
  }
  factor_->solve(coarse, coarse);
  for (std::size_t p = 0; p < box_of_.size(); ++p) {
    const double* block = coarse.data() + static_cast<std::size_t>(box_of_[p]) * width;
    for (int r = 0; r < rows_; ++r) {
      for (int f = 0; f < functions_; ++f) {
        result[p * rows_ + r] += block[r * functions_ + f] * values_[p * functions_ + f];
      }
    }
  }
}

}  // namespace perilink
