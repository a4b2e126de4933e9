#include "calibration/bounded_least_squares/normal_equations.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/error.hpp"

namespace perilink {
namespace {

/// Least regularisations of the method of multipliers. Singular values of waves along a boundary
/// fall with the square of their length; a factor allows a smaller regularisation.
constexpr double least_regularisation = 1e-10;
constexpr double factor_regularisation = 1e-18;
/// Regularisation of the last steps, smaller for long waves of unstructured particle sets.
constexpr double settled_regularisation = 1e-13;
/// Iterations that take as long as a factor, and iterations after which a factor is stale.
constexpr int worth_of_factor = 15, stale_iterations = 40;
/// Most iterations of a solution without a penalty by a factor of the present active-set weights.
/// Feasible ones took up to 62, infeasible ones, with a singular matrix, thousands.
constexpr int most_by_factor = 200;
/// Iterations of a solution after which the coarse space is made, or gets other modes.
/// Near-null-space modes take about 500 iterations of blocks, and are used in several solutions.
/// With modes of an earlier problem only the coarse system is made.
constexpr int patience = 200, patience_with_fields = 100, stale_fields = 200;
/// Iterations after which the coarse system is made again, which takes about forty iterations.
constexpr int stale_coarse = 80;
/// Iterations that take as long as the blocks.
constexpr int cheap_iterations = 10;

/// Least number of points for threads, and the number of parts of their sums.
constexpr std::size_t points_for_threads = 8000, parts_of_sums = 8;

}  // namespace

NormalEquations::Means NormalEquations::first_means(const LeastSquaresOptions& options,
                                                    const KeptPreconditioner& kept) {
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

NormalEquations::NormalEquations(const PointEquations& equations,
                                 const LeastSquaresOptions& options, KeptPreconditioner& kept)
    : NormalSystem(static_cast<std::size_t>(equations.num_variables())),
      options_(options),
      kept_(kept),
      by_(first_means(options, kept)),
      equations_(equations),
      size_(equations.right.size()),
      num_paired_(
          static_cast<std::size_t>(std::min(equations.num_variables(), equations.one_ended))),
      scaled_(size_) {
  if (std::isfinite(options.penalty)) compliance.assign(size_, 0.0);
  if (options.preconditioner == Preconditioner::blocks_then_boxes &&
      PackedProduct::serves(equations)) {
    packed_.emplace(equations);
  }
}

bool NormalEquations::threads_share() const {
  return packed_ && size_ / rows() > points_for_threads;
}

void NormalEquations::apply(const std::vector<double>& w, Vector& result) const {
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

/// Computes result = (A D A' + shift) y.
void NormalEquations::apply_system(const Vector& shift, const Vector& y, Vector& result) {
  for (std::size_t k = 0; k < size_; ++k) scaled_[k] = y[k] * equations_.scale[k];
  result.assign(size_, 0.0);
  add_product(scaled_, result);
  for (std::size_t k = 0; k < size_; ++k) {
    result[k] = result[k] * equations_.scale[k] + shift[k] * y[k];
  }
}

void NormalEquations::measure(const std::vector<double>& weights, const Vector& y,
                              Vector& residual) const {
  apply(weights, residual);
  for (std::size_t k = 0; k < size_; ++k) {
    residual[k] = equations_.right[k] * equations_.scale[k] - residual[k] -
                  equations_.ridge_of(k % rows()) * y[k] - relaxation(k, y[k]);
  }
}

void NormalEquations::build_blocks() {
  const std::vector<double> added = diagonal();
  std::vector<double> blocks;
  if (packed_) {
    packed_->set(active_weight);
    blocks = packed_->blocks();
    finish_blocks(equations_.rows, added, blocks);
  } else {
    blocks = point_blocks(equations_, active_weight, added);
  }
  invert_blocks(equations_.rows, blocks);
  set_blocks(blocks);
  // The coarse system can be kept for other weights; the blocks are cheap.
  if (by_ == Means::boxes && last_iterations_ > (kept_.boxes->is_nested() ? 2 : 1) * stale_coarse) {
    renew_coarse();
  }
}

/// Makes the coarse space. Where this fails for infeasible equations, only blocks are used.
template <class Make>
void NormalEquations::use_boxes(Make make) {
  try {
    make();
    by_ = Means::boxes;
    prepared_for_ = active_weight;
  } catch (const SolverError&) {
    kept_.boxes.reset();
    by_ = Means::only_blocks;
  }
}

void NormalEquations::renew_coarse() {
  use_boxes([&] { kept_.boxes->refactorize(equations_, active_weight, diagonal()); });
}

/// Returns the diagonal added to A D A', shape (points, rows).
NormalEquations::Vector NormalEquations::diagonal() const {
  Vector result(size_);
  for (std::size_t k = 0; k < size_; ++k) {
    result[k] = equations_.ridge_of(k % rows()) +
                std::max(regularisation, by_ == Means::factor          ? factor_regularisation
                                         : last_ && equations_.killing ? settled_regularisation
                                                                       : least_regularisation) +
                (compliance.empty() ? 0.0 : compliance[k]);
  }
  return result;
}

void NormalEquations::build_factor() {
  if (prepared_for_.empty()) kept_.factor = std::make_unique<EquationsFactor>(equations_);
  kept_.factor->factorize(equations_, active_weight, diagonal());
  compliance_of_factor_ = compliance;
  prepared_for_ = active_weight;
  last_iterations_ = 0;
}

void NormalEquations::prepare() {
  if (by_ != Means::factor) {
    build_blocks();
  } else if (!kept_.factor || last_iterations_ > worth_of_factor) {
    build_factor();
  }
}

void NormalEquations::prepare_if_stale(bool settled, bool last) {
  last_ = last;
  if (by_ != Means::factor) {
    if (!settled) build_blocks();
  } else if (!kept_.factor || last_iterations_ > stale_iterations ||
             compliance_of_factor_ != compliance) {
    build_factor();
  }
}

void NormalEquations::precondition(const Vector& residual, Vector& result) const {
  if (by_ == Means::factor) return kept_.factor->solve(residual, result);
  apply_blocks(residual, result);
  if (by_ == Means::boxes) kept_.boxes->add_correction(residual.data(), result.data());
}

int NormalEquations::solve(const Vector& residual, double reduction, Vector& direction) {
  DirectionSearch search{residual, reduction * norm(residual), residual, Vector(size_, 0.0)};
  search.rounded = packed_.has_value();
  search.keeps_directions = options_.keeps_directions && !search.rounded;
  find_direction(search);
  direction = std::move(search.direction);
  return gave_up_ ? options_.iterations : search.iterations;
}

/// Iterates with the present preconditioner, and with a stronger one when this takes too long.
void NormalEquations::find_direction(DirectionSearch& search) {
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
bool NormalEquations::iterate(DirectionSearch& search, int most) {
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
