#include "analysis/quasistatic/equilibrium/update/column_update.hpp"

#include <algorithm>
#include <cmath>

#include "assembly/element_vector.hpp"
#include "base/error.hpp"
#include "base/rare_branch.hpp"

namespace perilink {
namespace {

/// Largest error of a solution by columns, relative in the energy norm. It must be small, since an
/// element holds a small part of the energy.
constexpr double most_drift = 1e-10;

/// Residual above which errors of columns are removed, before they grow.
constexpr double fine_residual = 1e-13;

}  // namespace

void ColumnUpdate::begin(bool /*resists*/) {
  columns_.begin(body_.unknowns(), body_.secants(), body_.ground_stiffness());
}

/// Searches to the tolerance itself: batches need fewer digits than columns of single elements.
bool ColumnUpdate::search(std::vector<double>& residual, std::span<double> solution, double energy,
                          LoadSet /*kind*/) {
  try {
    columns_.follow(residual, energy / std::pow(SubdomainSolver::finer, 2));
  } catch (const SolverError&) {
    return false;
  }
  for (std::size_t k = 0; k < residual.size(); ++k) solution[k] += residual[k];
  return true;
}

void ColumnUpdate::solve_roughly(std::vector<double>& load, double energy) {
  columns_.correct(load, energy * std::pow(rough / tolerance_, 2));
}

/// Each change needs a block of columns; a cleared cache lacks all of its blocks.
bool ColumnUpdate::is_cheaper_anew(std::size_t changes) const {
  return changes > columns_.num_blocks() + 1;
}

std::optional<Drift> ColumnUpdate::drift() const {
  return Drift{tolerance_, fine_residual, most_drift};
}

bool ColumnUpdate::is_prepared(Index element) const {
  const ElementVectors parts = element_vectors(body_.network(), body_.unknowns(), element, 1.0);
  return std::all_of(parts.x.begin(), parts.x.begin() + parts.count,
                     [&](const SparseVector& x) { return columns_.holds(x); });
}

void ColumnUpdate::prepare(Index element, std::span<const Index> expected) {
  const auto vectors_of = [&](Index of, std::vector<SparseVector>& vectors) {
    const ElementVectors parts = element_vectors(body_.network(), body_.unknowns(), of, 1.0);
    vectors.insert(vectors.end(), parts.x.begin(), parts.x.begin() + parts.count);
  };
  std::vector<SparseVector> own, next;
  vectors_of(element, own);
  for (const Index other : expected) vectors_of(other, next);
  columns_.expect(std::move(next));
  columns_.hold(own);
}

/// Clears the column cache if a correction is large. The errors of columns grow with every event
/// that moves the same particles apart.
void ColumnUpdate::judge(double error, double energy) {
  // Written so that an energy that is not a number is too large.
  const bool small = error <= most_drift * most_drift * energy;
  if (!small || take_rare_branch("cleared columns")) columns_.clear();
}

}  // namespace perilink
