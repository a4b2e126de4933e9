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
/// Where none passes its bound any more a part of it does: with all, a step would leave a half of
/// the residual along the softest fields.
constexpr double least_proximity = 1e-10, settled_proximity = 1e-12;
/// Added to the diagonal of the factor beside that, relative to its mean: round-off must not make
/// rows negative that depend on others.
constexpr double factor_floor = 1e-13;
/// A new factor costs as much as this many iterations at least ...
constexpr int stale_iterations = 10;
/// ... and more of large factors: an operation of a solution, whose speed is that of the memory,
/// takes as long as so many of a factor. New factors are worth more than their time.
constexpr double slower = 4.0, worth_more = 4.0;
/// Where the equations contradict each other more do not help.
constexpr int most_tied_iterations = 400;

/// Calls visit(first, last) for the entries of a column, [first, last), at one point each.
template <class Visit>
void for_each_point(const TiedEquations::Matrix& columns, Index column, Index rows, Visit visit) {
  const int* begin = columns.innerIndexPtr();
  for (int k = columns.outerIndexPtr()[column]; k < columns.outerIndexPtr()[column + 1];) {
    const int first = k;
    while (k < columns.outerIndexPtr()[column + 1] && begin[k] / rows == begin[first] / rows) ++k;
    visit(first, k);
  }
}

PointMatrix::Pairs shared_points(const TiedEquations::Matrix& columns, Index rows) {
  PointMatrix::Pairs pairs;
  std::vector<Index> points;
  for (Index u = 0; u < static_cast<Index>(columns.rows()); ++u) {
    points.clear();
    for_each_point(columns, u, rows, [&](int first, int) {
      points.push_back(columns.innerIndexPtr()[first] / rows);
      for (const Index p : points) {
        if (p != points.back()) pairs.emplace_back(p, points.back());
      }
    });
  }
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  return pairs;
}

/// Squares of rows of a point below this part of the largest are none. Round-off leaves 1e-17, rows
/// that count 1e-9.
constexpr double independent = 1e-13;
/// Part of the squares of its rows that a basis of an earlier search may miss.
constexpr double missed = 1e-9;

/// The independent directions of the rows of a point, as columns, and zeros behind them.
/// \param products  A A'
Eigen::MatrixXd basis_of(const Eigen::MatrixXd& products) {
  const Eigen::Index rows = products.rows();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> squares(products);
  const Eigen::VectorXd& sizes = squares.eigenvalues();  // ascending
  const Eigen::Index none = (sizes.array() <= independent * sizes[rows - 1]).count();
  if (none == 0) return Eigen::MatrixXd::Identity(rows, rows);
  Eigen::MatrixXd basis = squares.eigenvectors().rowwise().reverse();
  basis.rightCols(none).setZero();
  return basis;
}

/// Symmetry of a place lets forces along what it mirrors vanish, and makes others follow from each
/// other. Such points get U'A in place of their rows A, U an orthonormal basis of what these span:
/// A'A is what it was, and so are the answer and the steps towards it.
void turn_rows(TiedEquations& tied, std::vector<Eigen::MatrixXd>& bases) {
  PointEquations& equations = tied.equations;
  const Eigen::Index rows = equations.rows;
  bases.resize(static_cast<std::size_t>(equations.num_points()));
  std::vector<Eigen::Triplet<double>> entries;
  for (std::size_t p = 0; p < bases.size(); ++p) {
    const Eigen::Index first = static_cast<Eigen::Index>(p) * rows;
    const TiedEquations::Matrix own = tied.matrix.middleRows(first, rows);
    const Eigen::MatrixXd products = (own * own.transpose()).toDense();
    Eigen::MatrixXd& basis = bases[p];
    const auto misses_some = [&] {
      const double held = (basis.transpose() * products * basis).trace();
      return held < (1.0 - missed) * products.trace();
    };
    if (basis.rows() != rows || misses_some()) basis = basis_of(products);
    for (Eigen::Index r = 0; r < rows; ++r) {
      for (TiedEquations::Matrix::InnerIterator entry(own, r); entry; ++entry) {
        for (Eigen::Index k = 0; k < rows; ++k) {
          if (basis(r, k) == 0.0) continue;
          entries.emplace_back(static_cast<int>(first + k), static_cast<int>(entry.col()),
                               basis(r, k) * entry.value());
        }
      }
    }
    Eigen::Map<Eigen::VectorXd> right(equations.right.data() + first, rows);
    Eigen::Map<Eigen::VectorXd> scale(equations.scale.data() + first, rows);
    right = (basis.transpose() * right.cwiseProduct(scale)).eval();
    scale.setOnes();
  }
  tied.matrix.setFromTriplets(entries.begin(), entries.end());
}

}  // namespace

std::vector<double> TiedEquations::weights(std::span<const double> unknowns) const {
  std::vector<double> result;
  result.reserve(unknown_of.size());
  for (const Index u : unknown_of) result.push_back(1.0 + (unknowns[u] - 1.0) / root[u]);
  return result;
}

TiedEquations tie(const PointEquations& equations, std::vector<Eigen::MatrixXd>& bases) {
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
  // With couples the search for a wall of one cell ended in round-off, at 2e-9 of the forces.
  if (equations.one_ended >= equations.num_variables()) turn_rows(tied, bases);
  return tied;
}

/// Where the rows of each point begin, without those that hold nothing.
std::vector<Index> TiedFactor::place_rows(const TiedEquations& tied) {
  std::vector<Index> first_row;
  for (Index k = 0; k < static_cast<Index>(tied.matrix.rows()); ++k) {
    if (k % rows_ == 0) first_row.push_back(static_cast<Index>(row_.size()));
    place_.push_back(static_cast<Index>(row_.size()) - first_row.back());
    if (tied.matrix.outerIndexPtr()[k + 1] > tied.matrix.outerIndexPtr()[k]) row_.push_back(k);
  }
  first_row.push_back(static_cast<Index>(row_.size()));
  return first_row;
}

TiedFactor::TiedFactor(const TiedEquations& tied, const TiedEquations::Matrix& columns)
    : rows_(tied.equations.rows), matrix_(place_rows(tied), shared_points(columns, rows_)) {}

bool TiedFactor::fits(const TiedEquations& tied, const TiedEquations::Matrix& columns) const {
  if (rows_ != tied.equations.rows || place_.size() != tied.equations.right.size()) return false;
  const auto holds = [&](Index row) { return std::ranges::binary_search(row_, row); };
  const std::span<const int> used(columns.innerIndexPtr(),
                                  static_cast<std::size_t>(columns.nonZeros()));
  return std::ranges::all_of(used, holds) && matrix_.holds(shared_points(columns, rows_));
}

void TiedFactor::factorize(const TiedEquations::Matrix& columns, std::span<const double> mobility,
                           std::span<const double> shift) {
  matrix_.set_zero();
  const int* row_of = columns.innerIndexPtr();
  const double* value = columns.valuePtr();
  for (Index u = 0; u < static_cast<Index>(columns.rows()); ++u) {
    if (mobility[u] == 0.0) continue;
    for_each_point(columns, u, rows_, [&](int first, int last) {
      const Index upper = row_of[first] / rows_;
      const auto add = [&](int from, int to) {
        const Index lower = row_of[from] / rows_;
        for (int c = first; c < last; ++c) {
          const double factor = value[c] * mobility[u];
          double* entries = matrix_.block(upper, lower, place_[row_of[c]]);
          for (int r = upper == lower ? c : from; r < to; ++r) {
            entries[place_[row_of[r]]] += factor * value[r];
          }
        }
      };
      for_each_point(columns, u, rows_, [&](int from, int to) {
        if (from >= first) add(from, to);
      });
    });
  }
  const auto entry = [&](Index row) -> double& {
    return matrix_.block(row / rows_, row / rows_, place_[row])[place_[row]];
  };
  double trace = 0.0;
  for (const Index row : row_) trace += entry(row);
  const double floor = factor_floor * trace / static_cast<double>(row_.size());
  for (const Index row : row_) entry(row) += entry(row) > 0.0 ? shift[row] + floor : 1.0;
  if (factor_) {
    factor_->refactorize(matrix_.matrix());
  } else {
    factor_ = make_factor(FactorRoute::in_place, omp_get_max_threads());
    factor_->factorize(matrix_.matrix(), matrix_.point_of_rows());
    statistics_ = factor_->statistics();
  }
}

void TiedFactor::solve(std::span<const double> residual, std::span<double> result) const {
  std::vector<double> some;
  for (const Index row : row_) some.push_back(residual[row]);
  factor_->solve(some, some);
  std::ranges::fill(result, 0.0);
  for (std::size_t k = 0; k < row_.size(); ++k) result[row_[k]] = some[k];
}

int TiedFactor::worth() const {
  const double solutions = statistics_.flops / (worth_more * operations_of_solution());
  return std::max(stale_iterations, static_cast<int>(solutions));
}

double TiedFactor::operations_of_solution() const { return 4.0 * slower * statistics_.entries; }

TiedNormalEquations::TiedNormalEquations(const TiedEquations& tied,
                                         std::unique_ptr<TiedFactor>& kept)
    : mobility(tied.root.size(), 1.0),
      tied_(tied),
      transposed_(tied.matrix.transpose()),
      shift_(tied.matrix.rows()),
      factor_(kept) {
  const std::size_t rows = static_cast<std::size_t>(tied.equations.rows);
  for (std::size_t k = 0; k < static_cast<std::size_t>(shift_.size()); ++k) {
    shift_[static_cast<Eigen::Index>(k)] = tied.equations.ridge_of(k % rows) + least_proximity;
  }
  if (factor_ && !factor_->fits(tied, transposed_)) factor_.reset();
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
  if (!factor_) factor_ = std::make_unique<TiedFactor>(tied_, transposed_);
  factor_->factorize(transposed_, mobility,
                     {shift_.data(), static_cast<std::size_t>(shift_.size())});
  spent_ += factor_->operations();
  last_iterations_ = 0;
}

void TiedNormalEquations::prepare_if_stale(bool /*settled*/, bool last) {
  eased_ = last ? least_proximity - settled_proximity : 0.0;
  if (!factor_ || last_iterations_ > factor_->worth()) prepare();
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
  return last_iterations_ = count;
}

}  // namespace perilink
