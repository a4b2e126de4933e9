#include "calibration/bounded_least_squares/symmetry_reduced/reduced_normal_equations.hpp"

#include <algorithm>
#include <cmath>

namespace perilink {
namespace {

using Column = Eigen::VectorXd;

Eigen::Map<const Column> map(const std::vector<double>& values) {
  return {values.data(), static_cast<Eigen::Index>(values.size())};
}

/// Computes product = matrix x with one thread: Eigen would use all threads, whose synchronisation
/// takes longer than the work.
void multiply(const ReducedEquations::Matrix& matrix, const Column& x, Column& product) {
  product.resize(matrix.rows());
  for (Eigen::Index k = 0; k < matrix.outerSize(); ++k) {
    double sum = 0.0;
    for (ReducedEquations::Matrix::InnerIterator entry(matrix, k); entry; ++entry) {
      sum += entry.value() * x[entry.col()];
    }
    product[k] = sum;
  }
}

/// Proximal regularisation. With less, Newton's method diverges where many weights pass their
/// bounds and rows are dependent. A part is enough once the active bounds are settled: with all of
/// it, a step would leave half of the residual along the modes of least stiffness.
constexpr double least_regularisation = 1e-10, independent_regularisation = 1e-12;
constexpr double settled_regularisation = 1e-13;
/// More iterations do not help infeasible equations.
constexpr int most_reduced_iterations = 400;
/// Least number of iterations that justify a new factor. A stale factor is replaced within a
/// solution after as many iterations as take the time of a new factor. It is replaced before a
/// solution that would need a quarter of them, since later solutions use the new factor too.
constexpr double least_of_stale = 10.0;

}  // namespace

ReducedNormalEquations::ReducedNormalEquations(const ReducedEquations& reduced,
                                               std::unique_ptr<ReducedFactor>& kept)
    : NormalSystem(reduced.root.size()),
      reduced_(reduced),
      transposed_(reduced.matrix.transpose()),
      regularisation_(reduced.independent ? independent_regularisation : least_regularisation),
      shift_(reduced.matrix.rows()),
      factor_(kept) {
  const std::size_t rows = static_cast<std::size_t>(reduced.equations.rows);
  for (std::size_t k = 0; k < static_cast<std::size_t>(shift_.size()); ++k) {
    shift_[static_cast<Eigen::Index>(k)] = reduced.equations.ridge_of(k % rows) + regularisation_;
  }
  if (factor_ && !factor_->fits(reduced, transposed_)) factor_.reset();
  if (factor_) factor_->sort(transposed_);
}

void ReducedNormalEquations::apply_transpose(const Vector& y, std::vector<double>& result) {
  Column product;
  multiply(transposed_, map(y), product);
  result.assign(product.begin(), product.end());
}

void ReducedNormalEquations::measure(const std::vector<double>& unknowns, const Vector& y,
                                     Vector& residual) const {
  const PointEquations& equations = reduced_.equations;
  Column embedded;
  multiply(reduced_.matrix, map(unknowns), embedded);
  residual.resize(equations.right.size());
  for (std::size_t k = 0; k < residual.size(); ++k) {
    residual[k] = equations.right[k] * equations.scale[k] - embedded[static_cast<Eigen::Index>(k)] -
                  equations.ridge_of(k % static_cast<std::size_t>(equations.rows)) * y[k];
  }
}

void ReducedNormalEquations::prepare() {
  if (!factor_) {
    factor_ = std::make_unique<ReducedFactor>(reduced_, transposed_);
    factor_->sort(transposed_);
  }
  factor_->factorize(reduced_.matrix, transposed_, active_weight,
                     {shift_.data(), static_cast<std::size_t>(shift_.size())});
  stale_ = false;
  gain_ = std::numeric_limits<double>::infinity();
}

void ReducedNormalEquations::prepare_if_stale(bool /*settled*/, bool last) {
  eased_ = last ? regularisation_ - settled_regularisation : 0.0;
  stale_ = true;
  if (!factor_) prepare();
}

int ReducedNormalEquations::solve(const Vector& residual, double reduction, Vector& direction) {
  const double price = std::max(least_of_stale, factor_->iterations_of_factor());
  const double worth = std::max(least_of_stale, 0.25 * price);
  if (stale_ && -std::log(reduction) > gain_ * worth) prepare();
  const std::size_t size = residual.size();
  Column r = map(residual), z(shift_.size()), q, stretch;
  direction.assign(size, 0.0);
  Eigen::Map<Column> x(direction.data(), shift_.size());
  const auto precondition = [&] { factor_->solve({r.data(), size}, {z.data(), size}); };
  precondition();
  Column p = z;
  double rz = r.dot(z);
  const double start = r.norm(), target = reduction * start;
  int count = 0;
  for (; count < most_reduced_iterations && r.norm() > target; ++count) {
    if (stale_ && count >= price) {
      prepare();
      precondition();
      p = z;
      rz = r.dot(z);
    }
    multiply(transposed_, p, stretch);
    stretch.array() *= map(active_weight).array();
    multiply(reduced_.matrix, stretch, q);
    q += (shift_.array() - eased_).matrix().cwiseProduct(p);
    const double step = rz / p.dot(q);
    x += step * p;
    r -= step * q;
    precondition();
    const double next = r.dot(z);
    p = z + next / rz * p;
    rz = next;
  }
  if (count > 0) gain_ = std::log(start / r.norm()) / count;
  return count;
}

}  // namespace perilink
