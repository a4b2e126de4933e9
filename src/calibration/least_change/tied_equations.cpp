#include "calibration/least_change/tied_equations.hpp"

#include <omp.h>

#include <algorithm>
#include <cmath>
#include <unordered_map>

#include "calibration/least_change/variable_parts.hpp"
#include "solver/factor_routes.hpp"

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

/// Weight of the method of multipliers, as without a factor. With less, Newton's method gets lost
/// where many weights pass their bounds: symmetry leaves rows that depend on each other.
constexpr double least_proximity = 1e-10;
/// Added to the diagonal of the factor beside that, relative to its mean: round-off must not make
/// rows negative that depend on others.
constexpr double factor_floor = 1e-13;
/// A new factor costs about as much as this many iterations.
constexpr int stale_iterations = 10;
/// Where the equations contradict each other more do not help.
constexpr int most_tied_iterations = 400;

}  // namespace

std::vector<double> TiedEquations::weights(std::span<const double> unknowns) const {
  std::vector<double> result;
  result.reserve(unknown_of.size());
  for (const Index u : unknown_of) result.push_back(1.0 + (unknowns[u] - 1.0) / root[u]);
  return result;
}

TiedEquations tie(const PointEquations& equations) {
  TiedEquations tied;
  PointEquations& small = tied.equations;
  small.dim = equations.dim;
  small.rows = equations.rows;
  small.odd = equations.odd;
  small.right = equations.right;
  small.scale = equations.scale;
  small.ridge = equations.ridge;
  std::unordered_map<Index, Index> numbers;
  for (const Index name : equations.unknown) {
    const Index u = numbers.emplace(name, static_cast<Index>(numbers.size())).first->second;
    tied.unknown_of.push_back(u);
    tied.root.resize(numbers.size(), 0.0);
    tied.root[u] += 1.0;
  }
  for (double& root : tied.root) root = std::sqrt(root);
  small.lower.resize(tied.root.size());
  small.upper.resize(tied.root.size());
  std::vector<Eigen::Triplet<double>> entries;
  const std::size_t rows = static_cast<std::size_t>(equations.rows);
  for (Index v = 0; v < equations.num_variables(); ++v) {
    const Index u = tied.unknown_of[v];
    const double root = tied.root[u];
    small.lower[u] = 1.0 + root * (equations.lower[v] - 1.0);
    small.upper[u] = 1.0 + root * (equations.upper[v] - 1.0);
    const double* a = equations.coefficients.data() + v * rows;
    for_each_part(equations, v, [&](Index p, int from, int to, double sign) {
      if (p == no_index) return;
      for (int r = from; r < to; ++r) {
        const std::size_t row = p * rows + r;
        const double value = sign * a[r];
        entries.emplace_back(static_cast<int>(row), u, equations.scale[row] * value / root);
        small.right[row] += value / root - value;
      }
    });
  }
  tied.matrix.resize(static_cast<Eigen::Index>(small.right.size()),
                     static_cast<Eigen::Index>(tied.root.size()));
  tied.matrix.setFromTriplets(entries.begin(), entries.end());
  return tied;
}

TiedNormalEquations::TiedNormalEquations(const TiedEquations& tied)
    : mobility(tied.root.size(), 1.0),
      tied_(tied),
      transposed_(tied.matrix.transpose()),
      shift_(tied.matrix.rows()) {
  const std::size_t rows = static_cast<std::size_t>(tied.equations.rows);
  for (std::size_t k = 0; k < static_cast<std::size_t>(shift_.size()); ++k) {
    shift_[static_cast<Eigen::Index>(k)] = tied.equations.ridge_of(k % rows) + least_proximity;
    point_.push_back(static_cast<Index>(k / rows));
  }
}

void TiedNormalEquations::apply_transpose(const Vector& y, std::vector<double>& result) const {
  Column product;
  multiply(transposed_, map(y), product);
  result.assign(product.begin(), product.end());
}

void TiedNormalEquations::measure(const std::vector<double>& unknowns, const Vector& y,
                                  Vector& residual) const {
  const PointEquations& equations = tied_.equations;
  Column carried;
  multiply(tied_.matrix, map(unknowns), carried);
  residual.resize(equations.right.size());
  for (std::size_t k = 0; k < residual.size(); ++k) {
    residual[k] = equations.right[k] * equations.scale[k] - carried[static_cast<Eigen::Index>(k)] -
                  equations.ridge_of(k % static_cast<std::size_t>(equations.rows)) * y[k];
  }
}

void TiedNormalEquations::prepare() {
  TiedEquations::Matrix weighted = transposed_;
  for (Eigen::Index u = 0; u < weighted.rows(); ++u) {
    weighted.row(u) *= mobility[static_cast<std::size_t>(u)];
  }
  const TiedEquations::Matrix product = tied_.matrix * weighted;
  SparseMatrix lower = SparseMatrix(product).triangularView<Eigen::Lower>();
  const double floor = factor_floor * lower.diagonal().mean();
  for (Index k = 0; k < lower.rows(); ++k) {
    double& diagonal = lower.coeffRef(k, k);
    diagonal += diagonal > 0.0 ? shift_[k] + floor : 1.0;  // symmetry leaves nothing to some rows
  }
  lower.makeCompressed();
  factor_ = make_factor(FactorRoute::in_place, omp_get_max_threads());
  factor_->factorize(lower, point_);
  last_iterations_ = 0;
}

void TiedNormalEquations::prepare_if_stale(bool) {
  if (!factor_ || last_iterations_ > stale_iterations) prepare();
}

int TiedNormalEquations::solve(const Vector& residual, double reduction, Vector& direction) {
  const std::size_t size = residual.size();
  Column r = map(residual), z(shift_.size()), q, stretch;
  direction.assign(size, 0.0);
  Eigen::Map<Column> x(direction.data(), shift_.size());
  const auto precondition = [&] { factor_->solve({r.data(), size}, {z.data(), size}); };
  precondition();
  Column p = z;
  double rz = r.dot(z);
  const double target = reduction * r.norm();
  int count = 0;
  for (; count < most_tied_iterations && r.norm() > target; ++count) {
    multiply(transposed_, p, stretch);
    stretch.array() *= map(mobility).array();
    multiply(tied_.matrix, stretch, q);
    q += shift_.cwiseProduct(p);
    const double step = rz / p.dot(q);
    x += step * p;
    r -= step * q;
    precondition();
    const double next = r.dot(z);
    p = z + next / rz * p;
    rz = next;
  }
  return last_iterations_ = count;
}

}  // namespace perilink
