#include "solver/preconditioner_factor.hpp"

#include <algorithm>
#include <cmath>
#include <new>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "solver/cholmod_support.hpp"
#include "solver/supernodes/supernodal_cholesky.hpp"
#include "solver/supernodes/supernodal_kernels.hpp"
#include "solver/supernodes/supernodes.hpp"

namespace perilink {

struct PreconditionerFactor::Parts {
  Parts(const SparseMatrix& lower, int most_threads)
      : threads(most_threads),
        pattern(analyze_supernodal(session, lower, {})),
        flops(session.get()->fl),
        count(static_cast<Index>(pattern->nsuper)),
        values(std::make_unique_for_overwrite<float[]>(pattern->xsize)),
        pivots(pattern->n) {
    Index longest = 0;
    for (Index s = 0; s < count; ++s) longest = std::max(longest, block(s).count);
    local.resize(static_cast<std::size_t>(longest));
  }

  Supernode<float> block(Index s) const { return supernode_of(*pattern, values.get(), s); }
  /// The part of a vector that belongs to a supernode.
  double* gather(const Supernode<float>& node, std::span<const double> vector) {
    std::copy_n(vector.data() + node.first, node.columns, local.data());
    for (Index r = node.columns; r < node.count; ++r) local[r] = vector[node.rows[r]];
    return local.data();
  }

  int threads;
  CholmodSession session;
  CholmodFactorPtr pattern;
  double flops;
  Index count;  // supernodes
  std::unique_ptr<float[]> values;
  std::vector<double> pivots;  // one over D
  std::vector<double> local;   // rows of a supernode
};

PreconditionerFactor::PreconditionerFactor(const SparseMatrix& lower, int threads) try
    : parts_(std::make_unique<Parts>(lower, threads)) {
} catch (const std::bad_alloc&) {
  throw SolverError("out of memory for the factor of a preconditioner of " +
                    std::to_string(lower.cols()) + " rows");
}

PreconditionerFactor::~PreconditionerFactor() = default;

bool PreconditionerFactor::factorize(const SparseMatrix& lower) {
  const Index failed =
      factorize_supernodes(lower, *parts_->pattern, parts_->values.get(), parts_->threads);
  if (failed < static_cast<Index>(lower.cols())) return false;
  turn_into_ldl();
  return std::ranges::all_of(parts_->pivots, [](double p) { return p > 0.0 && std::isfinite(p); });
}

void PreconditionerFactor::turn_into_ldl() {
#pragma omp parallel for schedule(dynamic, 16) num_threads(parts_->threads)
  for (Index s = 0; s < parts_->count; ++s) {
    const Supernode<float> node = parts_->block(s);
    for (Index j = 0; j < node.columns; ++j) {
      float* column = node.column(j);
      const float inverse = 1.0F / column[j];
      parts_->pivots[node.first + j] = static_cast<double>(inverse) * inverse;
      for (Index r = j + 1; r < node.count; ++r) column[r] *= inverse;
    }
  }
}

void PreconditionerFactor::solve(std::span<double> side) {
  for (Index s = 0; s < parts_->count; ++s) {
    const Supernode<float> node = parts_->block(s);
    double* local = parts_->gather(node, side);
    supernodal::forward(node.values, node.count, node.columns, 0, local);
    std::copy_n(local, node.columns, side.data() + node.first);
    for (Index r = node.columns; r < node.count; ++r) side[node.rows[r]] = local[r];
  }
  for (std::size_t k = 0; k < side.size(); ++k) side[k] *= parts_->pivots[k];
  for (Index s = parts_->count - 1; s >= 0; --s) {
    const Supernode<float> node = parts_->block(s);
    double* local = parts_->gather(node, side);
    supernodal::backward(node.values, node.count, node.columns, local);
    std::copy_n(local, node.columns, side.data() + node.first);
  }
}

FactorStatistics PreconditionerFactor::statistics() const {
  FactorStatistics result = measure_factor(*parts_->pattern, parts_->flops);
  result.bytes = 4.0 * (result.entries + static_cast<double>(parts_->pattern->ssize));
  return result;
}

}  // namespace perilink
