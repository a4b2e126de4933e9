#include "benchmarks/cholmod_reference.hpp"

#include <algorithm>
#include <vector>

#include "assembly/element_vector.hpp"
#include "assembly/stiffness.hpp"
#include "base/error.hpp"
#include "base/timer.hpp"
#include "solver/cholmod_support.hpp"

namespace perilink::verification {
namespace {

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

}  // namespace

CholmodReference time_cholmod(const Model& model, std::span<const Index> elements) {
  const std::vector<double> intact(static_cast<std::size_t>(model.network.num_elements()), 1.0);
  const SparseMatrix matrix = assemble_stiffness(model.network, intact, model.unknowns);
  std::vector<double> load =
      assemble_right_hand_side(model.network, intact, model.unknowns, model.loads);
  CholmodSession session;
  const CholmodFactorPtr factor = analyze_supernodal(session, matrix, model.unknowns.owners());
  factorize_numerically(session, matrix, factor.get(), 1);
  CholmodReference result;
  Timer timer;
  cholmod_change_factor(CHOLMOD_REAL, false, false, false, true, factor.get(), session.get());
  result.host_release = timer.seconds();
  const std::vector<Index> position = invert({static_cast<const Index*>(factor->Perm), factor->n});

  std::vector<double> downdate, solve;
  for (const Index element : elements) {
    PermutedColumn column(
        element_vector(model.network, model.unknowns, element, model.network.stiffness[element]),
        position, model.unknowns.count);
    timer.restart();
    if (!cholmod_updown(false, column.get(), factor.get(), session.get())) {
      throw SolverError("cholmod_updown failed");
    }
    downdate.push_back(timer.seconds());
    timer.restart();
    cholmod_dense b = view_column(load);
    cholmod_dense* u = cholmod_solve(CHOLMOD_A, factor.get(), &b, session.get());
    solve.push_back(timer.seconds());
    cholmod_free_dense(&u, session.get());
  }
  result.downdate = median(std::move(downdate));
  result.solve = median(std::move(solve));
  return result;
}

}  // namespace perilink::verification
