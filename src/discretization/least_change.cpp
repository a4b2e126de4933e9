#include "discretization/least_change.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>

#include <Eigen/Dense>

#include "discretization/coarse_space.hpp"
#include "discretization/variable_parts.hpp"

namespace perilink {
namespace {

/// Fewer points converge without a coarse space.
constexpr Index smallest_coarse_problem = 2000;

/// Weight of the method of multipliers, relative to equations of order one: contradictions decay by
/// this factor over the smallest squared singular value in each Newton step. Long waves along a boundary
/// have singular values that fall with the square of their length: a factor of the equations allows a smaller
/// weight.
constexpr double proximity = 1e-10;
constexpr double factor_proximity = 1e-14;

/// A step at settled weights that leaves more than this of the residual leaves contradictions.
constexpr double contradiction = 0.9;

constexpr int most_newton_steps = 40;

/// A factor is made anew when the last step needed more iterations than this.
constexpr int stale_iterations = 40;

/// Iterations of a step after which Preconditioner::blocks_then_factor turns to the factor.
constexpr int patience = 500;

double dot(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0.0;
  for (std::size_t k = 0; k < a.size(); ++k) sum += a[k] * b[k];
  return sum;
}

double norm(const std::vector<double>& a) { return std::sqrt(dot(a, a)); }

template <int Rows, int Odd, bool Grouped>
class DualNewton {
 public:
  using Vector = std::vector<double>;  // shape (points, Rows)
  using Block = Eigen::Matrix<double, Rows, Rows>;
  static constexpr int own = Grouped ? Rows - 1 : Rows;  // rows that hold at each point

  DualNewton(const PointEquations& equations, const LeastChangeOptions& options,
             std::unique_ptr<CoarseSpace>& coarse)
      : equations_(equations),
        options_(options),
        size_(equations.right.size()),
        num_paired_(static_cast<std::size_t>(
            std::min(equations.num_variables(), equations.one_ended))),
        active_(static_cast<std::size_t>(equations.num_variables()), 1.0),
        elongation_(active_.size()),
        weights_(active_.size(), 1.0),
        scaled_(size_),
        coarse_(coarse),
        by_factor_(options.preconditioner == Preconditioner::factor ||
                   (options.preconditioner == Preconditioner::blocks_then_factor && coarse)) {}

  LeastChange solve();

 private:
  template <class Values>
  auto& last_row(Values& values, Index point) const;
  void apply_transpose(const Vector& y, std::vector<double>& result);
  void apply(const std::vector<double>& w, Vector& result) const;
  double choose_weights(const Vector& y);
  double dual(const Vector& y);
  void measure(const Vector& y, Vector& residual);
  int newton_direction(const Vector& residual, double reduction, Vector& direction);
  void precondition(const Vector& residual, Vector& result) const;
  void build_blocks();
  void build_factor();
  void prepare(bool settled, int last_iterations);
  std::vector<double> shifts() const;
  double search_line(const Vector& residual, const Vector& direction, Vector& y);
  void report(const Vector& y, const Vector& residual, LeastChange& result) const;

  const PointEquations& equations_;
  const LeastChangeOptions& options_;
  std::size_t size_;
  std::size_t num_paired_;          // variables that act at both ends in all rows
  std::vector<double> active_;      // 1 between the bounds, else 0
  std::vector<double> elongation_;  // A' y
  std::vector<double> weights_;
  Vector scaled_;
  std::vector<Block> inverse_blocks_;
  std::unique_ptr<CoarseSpace>& coarse_;
  bool by_factor_;
};

/// Where the last row of a point's variables counts.
template <int Rows, int Odd, bool Grouped>
template <class Values>
auto& DualNewton<Rows, Odd, Grouped>::last_row(Values& values, Index point) const {
  return values[static_cast<std::size_t>(equations_.group[point]) * Rows + own];
}

/// result_v = a_v . (s y at the first end -+ s y at the second).
template <int Rows, int Odd, bool Grouped>
void DualNewton<Rows, Odd, Grouped>::apply_transpose(const Vector& y, std::vector<double>& result) {
  for (std::size_t k = 0; k < size_; ++k) scaled_[k] = y[k] * equations_.scale[k];
  const auto ends = [&](std::size_t v) {
    return std::pair(scaled_.data() + static_cast<std::size_t>(equations_.first[v]) * Rows,
                     scaled_.data() + static_cast<std::size_t>(equations_.second[v]) * Rows);
  };
  for (std::size_t v = 0; v < num_paired_; ++v) {
    const double* a = equations_.coefficients.data() + v * Rows;
    const auto [p, q] = ends(v);
    double sum = 0.0;
    for (int r = 0; r < Odd; ++r) sum += a[r] * (p[r] - q[r]);
    for (int r = Odd; r < own; ++r) sum += a[r] * (p[r] + q[r]);
    if constexpr (Grouped) sum += a[own] * (last_row(scaled_, equations_.first[v]) +
                                            last_row(scaled_, equations_.second[v]));
    result[v] = sum;
  }
  for (std::size_t v = num_paired_; v < result.size(); ++v) {
    const double* a = equations_.coefficients.data() + v * Rows;
    const auto [p, q] = ends(v);
    double sum = 0.0;
    for (int r = 0; r < Odd; ++r) sum += a[r] * (p[r] - q[r]);
    for (int r = Odd; r < own; ++r) sum += a[r] * p[r];
    result[v] = sum;
  }
}

template <int Rows, int Odd, bool Grouped>
void DualNewton<Rows, Odd, Grouped>::apply(const std::vector<double>& w, Vector& result) const {
  result.assign(size_, 0.0);
  for (std::size_t v = 0; v < w.size(); ++v) {
    const double* a = equations_.coefficients.data() + v * Rows;
    double* p = result.data() + static_cast<std::size_t>(equations_.first[v]) * Rows;
    double* q = result.data() + static_cast<std::size_t>(equations_.second[v]) * Rows;
    const double weight = w[v];
    for (int r = 0; r < Odd; ++r) {
      const double term = a[r] * weight;
      p[r] += term;
      q[r] -= term;
    }
    for (int r = Odd; r < own; ++r) p[r] += a[r] * weight;
    if (v >= num_paired_) continue;
    for (int r = Odd; r < own; ++r) q[r] += a[r] * weight;
    if constexpr (Grouped) {
      last_row(result, equations_.first[v]) += a[own] * weight;
      last_row(result, equations_.second[v]) += a[own] * weight;
    }
  }
  for (std::size_t k = 0; k < size_; ++k) result[k] *= equations_.scale[k];
}

/// Weights of a dual vector, and the part of the dual function that they make.
template <int Rows, int Odd, bool Grouped>
double DualNewton<Rows, Odd, Grouped>::choose_weights(const Vector& y) {
  apply_transpose(y, elongation_);
  double charge = 0.0;
  for (std::size_t v = 0; v < weights_.size(); ++v) {
    const double free = 1.0 + elongation_[v];
    weights_[v] = std::clamp(free, equations_.lower[v], equations_.upper[v]);
    active_[v] = weights_[v] == free ? 1.0 : 0.0;
    charge += weights_[v] * free - 0.5 * weights_[v] * weights_[v];
  }
  return charge;
}

template <int Rows, int Odd, bool Grouped>
double DualNewton<Rows, Odd, Grouped>::dual(const Vector& y) {
  double value = -choose_weights(y);
  for (std::size_t k = 0; k < size_; ++k) {
    const double ridge = equations_.ridge_of(k % Rows);
    value += y[k] * (equations_.right[k] * equations_.scale[k] - 0.5 * ridge * y[k]);
  }
  return value;
}

/// Gradient of the dual function, with the weights that choose_weights() left.
template <int Rows, int Odd, bool Grouped>
void DualNewton<Rows, Odd, Grouped>::measure(const Vector& y, Vector& residual) {
  apply(weights_, residual);
  for (std::size_t k = 0; k < size_; ++k) {
    residual[k] = equations_.right[k] * equations_.scale[k] - residual[k] -
                  equations_.ridge_of(k % Rows) * y[k];
  }
}

template <int Rows, int Odd, bool Grouped>
void DualNewton<Rows, Odd, Grouped>::build_blocks() {
  const Index points = equations_.num_points();
  inverse_blocks_.assign(static_cast<std::size_t>(points), Block::Zero());
  ColumnBlocks<Eigen::Matrix<double, Rows, 1>> column;
  for (std::size_t v = 0; v < active_.size(); ++v) {
    if (active_[v] == 0.0) continue;
    column.count = 0;
    const double* a = equations_.coefficients.data() + v * Rows;
    for_each_part(equations_, static_cast<Index>(v), [&](Index p, int from, int to, double sign) {
      const double* scale = equations_.scale.data() + static_cast<std::size_t>(p) * Rows;
      auto& part = column.of(p);
      for (int r = from; r < to; ++r) part[r] += sign * a[r] * scale[r];
    });
    for (int k = 0; k < column.count; ++k) {
      inverse_blocks_[column.keys[k]].noalias() += column.blocks[k] * column.blocks[k].transpose();
    }
  }
  const std::vector<double> shift = shifts();
  for (Block& block : inverse_blocks_) {
    // What no variable between the bounds acts on keeps the identity.
    const double floor = 1e-11 * block.trace();
    for (int r = 0; r < Rows; ++r) block(r, r) += block(r, r) > 0.0 ? floor + shift[r] : 1.0;
    block = block.llt().solve(Block::Identity()).eval();
  }
  if (options_.preconditioner == Preconditioner::aggregates && points >= smallest_coarse_problem) {
    coarse_ = std::make_unique<CoarseSpace>(equations_, active_, shifts(),
                                            CoarseSpace::Boxes::of_many_points);
  }
}

/// Ridge and proximity of each row.
template <int Rows, int Odd, bool Grouped>
std::vector<double> DualNewton<Rows, Odd, Grouped>::shifts() const {
  std::vector<double> result;
  for (std::size_t r = 0; r < Rows; ++r) {
    result.push_back(equations_.ridge_of(r) + (by_factor_ ? factor_proximity : proximity));
  }
  return result;
}

template <int Rows, int Odd, bool Grouped>
void DualNewton<Rows, Odd, Grouped>::build_factor() {
  by_factor_ = true;
  inverse_blocks_.clear();
  coarse_ = std::make_unique<CoarseSpace>(equations_, active_, shifts(),
                                          CoarseSpace::Boxes::of_single_points);
}

/// The factor of an earlier pattern serves until it needs too many iterations.
template <int Rows, int Odd, bool Grouped>
void DualNewton<Rows, Odd, Grouped>::prepare(bool settled, int last_iterations) {
  if (!by_factor_) {
    if (!settled) build_blocks();
  } else if (!coarse_ || last_iterations > stale_iterations) {
    build_factor();
  }
}

template <int Rows, int Odd, bool Grouped>
void DualNewton<Rows, Odd, Grouped>::precondition(const Vector& residual, Vector& result) const {
  using Column = Eigen::Matrix<double, Rows, 1>;
  if (by_factor_) std::fill(result.begin(), result.end(), 0.0);
  for (std::size_t p = 0; p < inverse_blocks_.size(); ++p) {
    Eigen::Map<Column>(result.data() + p * Rows).noalias() =
        inverse_blocks_[p] * Eigen::Map<const Column>(residual.data() + p * Rows);
  }
  if (coarse_) coarse_->add_correction(residual.data(), result.data());
}

/// Conjugate gradients on (A D A' + ridge + proximity) direction = residual.
/// \return iterations
template <int Rows, int Odd, bool Grouped>
int DualNewton<Rows, Odd, Grouped>::newton_direction(const Vector& residual, double reduction,
                                       Vector& direction) {
  const std::vector<double> shift = shifts();
  Vector r = residual, z(size_), q(size_);
  std::vector<double> stretch(active_.size());
  direction.assign(size_, 0.0);
  precondition(r, z);
  Vector p = z;
  double rz = dot(r, z);
  const double target = reduction * norm(residual);
  int count = 0;
  const bool impatient = !by_factor_ && options_.preconditioner == Preconditioner::blocks_then_factor;
  const int most = impatient ? patience : options_.iterations;
  for (; count < most && norm(r) > target; ++count) {
    apply_transpose(p, stretch);
    for (std::size_t v = 0; v < stretch.size(); ++v) stretch[v] *= active_[v];
    apply(stretch, q);
    for (std::size_t k = 0; k < size_; ++k) q[k] += shift[k % Rows] * p[k];
    const double step = rz / dot(p, q);
    for (std::size_t k = 0; k < size_; ++k) {
      direction[k] += step * p[k];
      r[k] -= step * q[k];
    }
    precondition(r, z);
    const double next = dot(r, z);
    for (std::size_t k = 0; k < size_; ++k) p[k] = z[k] + next / rz * p[k];
    rz = next;
  }
  return count;
}

/// Halves the step until the concave dual function grows. \return length of the step
template <int Rows, int Odd, bool Grouped>
double DualNewton<Rows, Odd, Grouped>::search_line(const Vector& residual, const Vector& direction, Vector& y) {
  const double before = dual(y);
  const double slope = dot(residual, direction);
  Vector trial(size_);
  double step = 1.0;
  for (int halvings = 0; halvings < 30; ++halvings, step *= 0.5) {
    for (std::size_t k = 0; k < size_; ++k) trial[k] = y[k] + step * direction[k];
    // Round-off of the sums in dual(): 1e-13 of their size.
    if (dual(trial) >= before + 1e-4 * step * slope - 1e-13 * std::abs(before)) break;
  }
  y = trial;
  return step;
}

template <int Rows, int Odd, bool Grouped>
LeastChange DualNewton<Rows, Odd, Grouped>::solve() {
  LeastChange result;
  Vector y(size_, 0.0), residual, direction(size_);
  const double target =
      options_.tolerance * std::sqrt(static_cast<double>(std::max<Index>(equations_.num_points(), 1)));
  choose_weights(y);
  measure(y, residual);
  double last_size = 0.0;
  std::vector<double> pattern;  // weights between their bounds at the last step
  int last = 0;                 // iterations of that step
  for (int step = 0; step < most_newton_steps; ++step) {
    const double size = norm(residual);
    if (size <= target || result.iterations >= options_.iterations) break;
    const bool settled = pattern == active_;
    if (settled && size > contradiction * last_size) break;
    last_size = size;
    prepare(settled, last);
    pattern = active_;
    // The first steps only find out which weights are at their bounds.
    const double coarse = step == 0 ? 1e-2 : settled ? 0.0 : 1e-3;
    const double reduction = std::max({coarse, 0.3 * target / size, 1e-12});
    last = newton_direction(residual, reduction, direction);
    result.iterations += last;
    if (!by_factor_ && options_.preconditioner == Preconditioner::blocks_then_factor &&
        last == patience) {
      build_factor();
      last = newton_direction(residual, reduction, direction);
      result.iterations += last;
    }
    search_line(residual, direction, y);
    measure(y, residual);
  }
  result.converged = norm(residual) <= target;
  report(y, residual, result);
  return result;
}

template <int Rows, int Odd, bool Grouped>
void DualNewton<Rows, Odd, Grouped>::report(const Vector& y, const Vector& residual, LeastChange& result) const {
  result.weights = weights_;
  for (std::size_t v = 0; v < weights_.size(); ++v) {
    result.at_lower += weights_[v] <= equations_.lower[v];
  }
  for (std::size_t k = 0; k < size_; ++k) {
    const double rest = std::abs(residual[k] + equations_.ridge_of(k % Rows) * y[k]);
    if (rest <= result.residual) continue;
    result.residual = rest;
    result.worst_point = static_cast<Index>(k / Rows);
  }
}

}  // namespace

LeastChange least_change(const PointEquations& equations, const LeastChangeOptions& options,
                         std::unique_ptr<CoarseSpace>& factor) {
  const auto are = [&](int rows, int odd, bool grouped) {
    return equations.rows == rows && equations.odd == odd && equations.group.empty() != grouped;
  };
  // Moduli of a family of bonds without and with moments in two and three dimensions.
  if (are(5, 0, false)) return DualNewton<5, 0, false>(equations, options, factor).solve();
  if (are(8, 0, false)) return DualNewton<8, 0, false>(equations, options, factor).solve();
  if (are(15, 0, false)) return DualNewton<15, 0, false>(equations, options, factor).solve();
  if (are(26, 0, false)) return DualNewton<26, 0, false>(equations, options, factor).solve();
  // Their forces, and with them energies.
  if (are(4, 4, false)) return DualNewton<4, 4, false>(equations, options, factor).solve();
  if (are(5, 4, true)) return DualNewton<5, 4, true>(equations, options, factor).solve();
  if (are(8, 6, false)) return DualNewton<8, 6, false>(equations, options, factor).solve();
  if (are(9, 6, true)) return DualNewton<9, 6, true>(equations, options, factor).solve();
  if (are(10, 10, false)) return DualNewton<10, 10, false>(equations, options, factor).solve();
  if (are(11, 10, true)) return DualNewton<11, 10, true>(equations, options, factor).solve();
  if (are(18, 13, false)) return DualNewton<18, 13, false>(equations, options, factor).solve();
  if (are(19, 13, true)) return DualNewton<19, 13, true>(equations, options, factor).solve();
  throw std::invalid_argument(std::to_string(equations.rows) + " equations per point, " +
                              std::to_string(equations.odd) + " of them odd, are not built in");
}

LeastChange least_change(const PointEquations& equations, const LeastChangeOptions& options) {
  std::unique_ptr<CoarseSpace> factor;
  return least_change(equations, options, factor);
}

}  // namespace perilink
