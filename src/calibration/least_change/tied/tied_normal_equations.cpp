#include "calibration/least_change/tied/tied_normal_equations.hpp"

#include <cmath>

namespace perilink {
namespace {

using Column = Eigen::VectorXd;

Eigen::Map<const Column> map(const std::vector<double>& values) {
  return {values.data(), static_cast<Eigen::Index>(values.size())};
}

/// product = matrix x, by one thread: Eigen would take all, and they wait longer for each other
/// than the work takes.
void multiply(const TiedEquations::Matrix& matrix, const Column& x, Column& product) {
  product.resize(matrix.rows());
  for (Eigen::Index k = 0; k < matrix.outerSize(); ++k) {
    double sum = 0.0;
    for (TiedEquations::Matrix::InnerIterator entry(matrix, k); entry; ++entry) {
      sum += entry.value() * x[entry.col()];
    }
    product[k] = sum;
  }
}

/// Weight of the method of multipliers. With less, Newton's method gets lost where many weights
/// pass their bounds and rows depend on each other. Where none passes its bound any more a part of
/// it does: with all, a step would leave a half of the residual along the softest fields.
constexpr double least_proximity = 1e-10, independent_proximity = 1e-12;
constexpr double settled_proximity = 1e-13;
/// Where the equations contradict each other more do not help.
constexpr int most_tied_iterations = 400;

}  // namespace

TiedNormalEquations::TiedNormalEquations(const TiedEquations& tied,
                                         std::unique_ptr<TiedFactor>& kept)
    : mobility(tied.root.size(), 1.0),
      tied_(tied),
      transposed_(tied.matrix.transpose()),
      proximity_(tied.independent ? independent_proximity : least_proximity),
      shift_(tied.matrix.rows()),
      factor_(kept) {
  const std::size_t rows = static_cast<std::size_t>(tied.equations.rows);
  for (std::size_t k = 0; k < static_cast<std::size_t>(shift_.size()); ++k) {
    shift_[static_cast<Eigen::Index>(k)] = tied.equations.ridge_of(k % rows) + proximity_;
  }
  if (factor_ && !factor_->fits(tied, transposed_)) factor_.reset();
  if (factor_) factor_->sort(transposed_);
}

void TiedNormalEquations::apply_transpose(const Vector& y, std::vector<double>& result) const {
  Column product;
  multiply(transposed_, map(y), product);
  result.assign(product.begin(), product.end());
}

void TiedNormalEquations::measure(const std::vector<double>& unknowns, const Vector& y,
                                  Vector& residual) const {
  const PointEquations& equations = tied_.equations;
  Column embedded;
  multiply(tied_.matrix, map(unknowns), embedded);
  residual.resize(equations.right.size());
  for (std::size_t k = 0; k < residual.size(); ++k) {
    residual[k] = equations.right[k] * equations.scale[k] - embedded[static_cast<Eigen::Index>(k)] -
                  equations.ridge_of(k % static_cast<std::size_t>(equations.rows)) * y[k];
  }
}

void TiedNormalEquations::prepare() {
  if (!factor_) {
    factor_ = std::make_unique<TiedFactor>(tied_, transposed_);
    factor_->sort(transposed_);
  }
  factor_->factorize(tied_.matrix, transposed_, mobility,
                     {shift_.data(), static_cast<std::size_t>(shift_.size())});
  spent_ += factor_->operations();
  stale_ = false;
  gain_ = std::numeric_limits<double>::infinity();
}

void TiedNormalEquations::prepare_if_stale(bool /*settled*/, bool last) {
  eased_ = last ? proximity_ - settled_proximity : 0.0;
  stale_ = true;
  if (!factor_) prepare();
}

int TiedNormalEquations::solve(const Vector& residual, double reduction, Vector& direction) {
  if (stale_ && -std::log(reduction) > gain_ * factor_->worth()) prepare();
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
  for (; count < most_tied_iterations && r.norm() > target; ++count) {
    if (stale_ && count >= factor_->price()) {
      prepare();
      precondition();
      p = z;
      rz = r.dot(z);
    }
    multiply(transposed_, p, stretch);
    stretch.array() *= map(mobility).array();
    multiply(tied_.matrix, stretch, q);
    q += (shift_.array() - eased_).matrix().cwiseProduct(p);
    const double step = rz / p.dot(q);
    x += step * p;
    r -= step * q;
    precondition();
    const double next = r.dot(z);
    p = z + next / rz * p;
    rz = next;
  }
  spent_ += count * factor_->operations_of_solution();
  if (count > 0) gain_ = std::log(start / r.norm()) / count;
  return count;
}

}  // namespace perilink
