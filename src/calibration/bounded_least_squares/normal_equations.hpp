#pragma once

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include <Eigen/Dense>

#include "base/error.hpp"
#include "calibration/bounded_least_squares/direction_search.hpp"
#include "calibration/bounded_least_squares/equations/normal_system.hpp"
#include "calibration/bounded_least_squares/equations/point_equations.hpp"
#include "calibration/bounded_least_squares/equations/variable_parts.hpp"
#include "calibration/bounded_least_squares/kept_preconditioner.hpp"
#include "calibration/bounded_least_squares/normal_equations_limits.hpp"
#include "calibration/bounded_least_squares/packed_product.hpp"
#include "calibration/bounded_least_squares/system_product.hpp"

namespace perilink {

/// NormalSystem of equations at points, by conjugate gradients.
/// \tparam Rows  equations per point
/// \tparam Odd  the first of them, of opposite sign at the two ends of a variable
/// \tparam Grouped  whether the last equation of a point is shared by its group
template <int Rows, int Odd, bool Grouped>
class NormalEquations final : public NormalSystem, private NormalEquationsLimits {
 public:
  NormalEquations(const PointEquations& equations, const LeastSquaresOptions& options,
                  KeptPreconditioner& kept)
      : NormalSystem(static_cast<std::size_t>(equations.num_variables())),
        equations_(equations),
        options_(options),
        size_(equations.right.size()),
        num_paired_(
            static_cast<std::size_t>(std::min(equations.num_variables(), equations.one_ended))),
        scaled_(size_),
        kept_(kept),
        by_(first_means(options, kept)) {
    if (std::isfinite(options.penalty)) compliance.assign(size_, 0.0);
    if (options.preconditioner == Preconditioner::blocks_then_boxes &&
        PackedProduct::serves(equations)) {
      packed_.emplace(equations);
    }
  }

  void apply_transpose(const Vector& y, std::vector<double>& result) override;
  void measure(const std::vector<double>& weights, const Vector& y,
               Vector& residual) const override;
  void prepare() override;
  void prepare_if_stale(bool settled, bool last) override;
  int solve(const Vector& residual, double reduction, Vector& direction) override;
  double penalty() const override { return options_.penalty; }
  bool has_penalty(std::size_t k) const override {
    return std::isfinite(options_.penalty) && equations_.ridge_of(k % Rows) == 0.0;
  }

 private:
  using Block = Eigen::Matrix<double, Rows, Rows>;
  static constexpr int own = Grouped ? Rows - 1 : Rows;  // rows per point, without the group row

  /// Least number of points for threads, and the number of parts of their sums.
  static constexpr std::size_t points_for_threads = 8000, parts_of_sums = 8;

  template <class Values>
  auto& last_row(Values& values, Index point) const {
    return values[static_cast<std::size_t>(equations_.group[point]) * Rows + own];
  }
  void apply(const std::vector<double>& w, Vector& result) const;
  bool threads_share() const { return packed_ && size_ / Rows > points_for_threads; }
  void add_forces(const std::vector<double>& w, std::size_t begin, std::size_t end,
                  Vector& result) const;
  void find_direction(DirectionSearch& search);
  bool iterate(DirectionSearch& search, int most);
  void apply_system(const Vector& shift, const Vector& y, Vector& result);
  void precondition(const Vector& residual, Vector& result) const;
  /// Means of the preconditioner: blocks, which may get a coarse space or give way to a factor;
  /// blocks with a coarse space; a factor; blocks to the end.
  enum class Means { blocks, boxes, factor, only_blocks };
  static Means first_means(const LeastSquaresOptions& options, const KeptPreconditioner& kept) {
    switch (options.preconditioner) {
      case Preconditioner::factor: return Means::factor;
      case Preconditioner::blocks_then_factor: return kept.factor ? Means::factor : Means::blocks;
      case Preconditioner::blocks_then_boxes:
        // The first steps of the interior-point method have other near-null-space modes: blocks are
        // better.
        return kept.boxes && options.method == Method::newton ? Means::boxes : Means::blocks;
      case Preconditioner::blocks: break;
    }
    return Means::only_blocks;
  }
  void build_blocks();
  template <class Make>
  void use_boxes(Make make);
  void renew_coarse();
  void build_factor();
  Vector diagonal() const;

  const PointEquations& equations_;
  const LeastSquaresOptions& options_;
  std::size_t size_;
  std::size_t num_paired_;  // variables that act at both ends in all rows
  Vector scaled_;
  std::vector<Block> inverse_blocks_;
  KeptPreconditioner& kept_;
  Means by_;
  std::optional<PackedProduct> packed_;  // for the steps of conjugate gradients
  bool last_ = false;                    // whether the step must satisfy the equations
  int last_iterations_ = 0;
  bool gave_up_ = false;  // not even a new factor leads to a solution
  /// Active-set weights of the factor or the coarse system; empty: of another problem.
  std::vector<double> prepared_for_;
  Vector compliance_of_factor_;
};

/// Computes result_v = a_v . (s y at the first end -+ s y at the second).
template <int Rows, int Odd, bool Grouped>
void NormalEquations<Rows, Odd, Grouped>::apply_transpose(const Vector& y,
                                                          std::vector<double>& result) {
  for (std::size_t k = 0; k < size_; ++k) scaled_[k] = y[k] * equations_.scale[k];
  const auto ends = [&](std::size_t v) {
    return std::pair(scaled_.data() + static_cast<std::size_t>(equations_.first[v]) * Rows,
                     scaled_.data() + static_cast<std::size_t>(equations_.second[v]) * Rows);
  };
#pragma omp parallel for schedule(static) if (threads_share())
  for (std::size_t v = 0; v < num_paired_; ++v) {
    const double* a = equations_.coefficients.data() + v * Rows;
    const auto [p, q] = ends(v);
    double sum = 0.0;
    for (int r = 0; r < Odd; ++r) sum += a[r] * (p[r] - q[r]);
    for (int r = Odd; r < own; ++r) sum += a[r] * (p[r] + q[r]);
    if constexpr (Grouped)
      sum += a[own] *
             (last_row(scaled_, equations_.first[v]) + last_row(scaled_, equations_.second[v]));
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
void NormalEquations<Rows, Odd, Grouped>::apply(const std::vector<double>& w,
                                                Vector& result) const {
  std::vector<Vector> sums(threads_share() ? parts_of_sums : 1);
  const std::size_t parts = sums.size();
#pragma omp parallel for schedule(static) if (parts > 1)
  for (std::size_t part = 0; part < parts; ++part) {
    sums[part].assign(size_, 0.0);
    add_forces(w, part * w.size() / parts, (part + 1) * w.size() / parts, sums[part]);
  }
  result = std::move(sums.front());
  for (std::size_t part = 1; part < parts; ++part) {
    for (std::size_t k = 0; k < size_; ++k) result[k] += sums[part][k];
  }
  for (std::size_t k = 0; k < size_; ++k) result[k] *= equations_.scale[k];
}

/// Adds the forces of a range of variables, times their weights.
template <int Rows, int Odd, bool Grouped>
void NormalEquations<Rows, Odd, Grouped>::add_forces(const std::vector<double>& w,
                                                     std::size_t begin, std::size_t end,
                                                     Vector& result) const {
  for (std::size_t v = begin; v < end; ++v) {
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
}

/// Computes result = (A D A' + shift) y.
template <int Rows, int Odd, bool Grouped>
void NormalEquations<Rows, Odd, Grouped>::apply_system(const Vector& shift, const Vector& y,
                                                       Vector& result) {
  for (std::size_t k = 0; k < size_; ++k) scaled_[k] = y[k] * equations_.scale[k];
  result.assign(size_, 0.0);
  add_system_product<Rows, Odd, Grouped>(equations_, active_weight, scaled_, result);
  for (std::size_t k = 0; k < size_; ++k) {
    result[k] = result[k] * equations_.scale[k] + shift[k] * y[k];
  }
}

template <int Rows, int Odd, bool Grouped>
void NormalEquations<Rows, Odd, Grouped>::measure(const std::vector<double>& weights,
                                                  const Vector& y, Vector& residual) const {
  apply(weights, residual);
  for (std::size_t k = 0; k < size_; ++k) {
    residual[k] = equations_.right[k] * equations_.scale[k] - residual[k] -
                  equations_.ridge_of(k % Rows) * y[k] - relaxation(k, y[k]);
  }
}

template <int Rows, int Odd, bool Grouped>
void NormalEquations<Rows, Odd, Grouped>::build_blocks() {
  const std::vector<double> added = diagonal();
  std::vector<double> blocks;
  if (packed_) {
    packed_->set(active_weight);
    blocks = packed_->blocks();
    finish_blocks(Rows, added, blocks);
  } else {
    blocks = point_blocks(equations_, active_weight, added);
  }
  invert_blocks(Rows, blocks);
  inverse_blocks_.resize(size_ / Rows);
  for (std::size_t p = 0; p < inverse_blocks_.size(); ++p) {
    inverse_blocks_[p] = Eigen::Map<const Block>(blocks.data() + p * Rows * Rows);
  }
  // The coarse system can be kept for other weights; the blocks are cheap.
  if (by_ == Means::boxes && last_iterations_ > (kept_.boxes->is_nested() ? 2 : 1) * stale_coarse) {
    renew_coarse();
  }
}

/// Makes the coarse space. Where this fails for infeasible equations, only blocks are used.
template <int Rows, int Odd, bool Grouped>
template <class Make>
void NormalEquations<Rows, Odd, Grouped>::use_boxes(Make make) {
  try {
    make();
    by_ = Means::boxes;
    prepared_for_ = active_weight;
  } catch (const SolverError&) {
    kept_.boxes.reset();
    by_ = Means::only_blocks;
  }
}

template <int Rows, int Odd, bool Grouped>
void NormalEquations<Rows, Odd, Grouped>::renew_coarse() {
  use_boxes([&] { kept_.boxes->refactorize(equations_, active_weight, diagonal()); });
}

/// Returns the diagonal added to A D A', shape (points, Rows).
template <int Rows, int Odd, bool Grouped>
auto NormalEquations<Rows, Odd, Grouped>::diagonal() const -> Vector {
  Vector result(size_);
  for (std::size_t k = 0; k < size_; ++k) {
    result[k] = equations_.ridge_of(k % Rows) +
                std::max(regularisation, by_ == Means::factor          ? factor_regularisation
                                         : last_ && equations_.killing ? settled_regularisation
                                                                       : least_regularisation) +
                (compliance.empty() ? 0.0 : compliance[k]);
  }
  return result;
}

template <int Rows, int Odd, bool Grouped>
void NormalEquations<Rows, Odd, Grouped>::build_factor() {
  if (prepared_for_.empty()) kept_.factor = std::make_unique<EquationsFactor>(equations_);
  kept_.factor->factorize(equations_, active_weight, diagonal());
  compliance_of_factor_ = compliance;
  prepared_for_ = active_weight;
  last_iterations_ = 0;
}

template <int Rows, int Odd, bool Grouped>
void NormalEquations<Rows, Odd, Grouped>::prepare() {
  if (by_ != Means::factor) {
    build_blocks();
  } else if (!kept_.factor || last_iterations_ > worth_of_factor) {
    build_factor();
  }
}

template <int Rows, int Odd, bool Grouped>
void NormalEquations<Rows, Odd, Grouped>::prepare_if_stale(bool settled, bool last) {
  last_ = last;
  if (by_ != Means::factor) {
    if (!settled) build_blocks();
  } else if (!kept_.factor || last_iterations_ > stale_iterations ||
             compliance_of_factor_ != compliance) {
    build_factor();
  }
}

template <int Rows, int Odd, bool Grouped>
void NormalEquations<Rows, Odd, Grouped>::precondition(const Vector& residual,
                                                       Vector& result) const {
  using Column = Eigen::Matrix<double, Rows, 1>;
  if (by_ == Means::factor) return kept_.factor->solve(residual, result);
#pragma omp parallel for schedule(static) if (threads_share())
  for (std::size_t p = 0; p < inverse_blocks_.size(); ++p) {
    Eigen::Map<Column>(result.data() + p * Rows).noalias() =
        inverse_blocks_[p] * Eigen::Map<const Column>(residual.data() + p * Rows);
  }
  if (by_ == Means::boxes) kept_.boxes->add_correction(residual.data(), result.data());
}

template <int Rows, int Odd, bool Grouped>
int NormalEquations<Rows, Odd, Grouped>::solve(const Vector& residual, double reduction,
                                               Vector& direction) {
  DirectionSearch search{residual, reduction * norm(residual), residual, Vector(size_, 0.0)};
  search.rounded = packed_.has_value();
  search.keeps_directions = options_.keeps_directions && !search.rounded;
  find_direction(search);
  direction = std::move(search.direction);
  return gave_up_ ? options_.iterations : search.iterations;
}

/// Iterates with the present preconditioner, and with a stronger one when this takes too long.
template <int Rows, int Odd, bool Grouped>
void NormalEquations<Rows, Odd, Grouped>::find_direction(DirectionSearch& search) {
  if (options_.preconditioner == Preconditioner::factor && !std::isfinite(penalty())) {
    if (iterate(search, most_by_factor)) return;
    if (prepared_for_ != active_weight) {
      build_factor();
      if (iterate(search, most_by_factor)) return;
    }
    gave_up_ = true;
    return;
  }
  const int times = kept_.boxes && kept_.boxes->is_nested() ? 2 : 1;
  if (by_ == Means::boxes && prepared_for_ != active_weight) {
    if (iterate(search, times * stale_coarse)) return;
    renew_coarse();
  }
  const int most_alone = kept_.boxes ? patience_with_fields : patience;
  const int most = by_ == Means::boxes    ? times * stale_fields
                   : by_ == Means::blocks ? most_alone
                                          : options_.iterations;
  if (iterate(search, most) || by_ == Means::factor || by_ == Means::only_blocks) return;
  if (options_.preconditioner == Preconditioner::blocks_then_factor) {
    by_ = Means::factor;
    build_factor();
  } else {
    if (by_ == Means::blocks && kept_.boxes) {
      renew_coarse();
      if (iterate(search, times * stale_coarse)) return;
    }
    const CoarseModes fields =
        equations_.killing && !kept_.boxes ? CoarseModes::killing : CoarseModes::soft;
    use_boxes([&] {
      kept_.boxes = std::make_unique<CoarseSpace>(equations_, active_weight, diagonal(), fields);
    });
  }
  iterate(search, options_.iterations);
}

/// Iterates at most `most` times. \return whether the target is reached
template <int Rows, int Odd, bool Grouped>
bool NormalEquations<Rows, Odd, Grouped>::iterate(DirectionSearch& search, int most) {
  const Vector shift = diagonal();
  const int before = search.iterations;
  search.cheap_iterations =
      by_ == Means::blocks || by_ == Means::only_blocks ? cheap_iterations : 0;
  const bool reached = descend(
      search, most, [&](const Vector& y, Vector& result) { apply_system(shift, y, result); },
      [&](const Vector& y, Vector& result) {
        if (!search.rounded) return apply_system(shift, y, result);
        packed_->apply(y, result);
        for (std::size_t k = 0; k < size_; ++k) result[k] += shift[k] * y[k];
      },
      [&](const Vector& residual, Vector& result) { precondition(residual, result); });
  last_iterations_ = search.iterations - before;
  return reached;
}

}  // namespace perilink
