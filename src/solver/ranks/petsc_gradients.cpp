#include "solver/ranks/petsc_gradients.hpp"

#include <petscksp.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <exception>

#include "solver/conjugate_gradients.hpp"
#include "solver/not_positive_definite.hpp"

namespace perilink {
namespace {

/// What PETSc's callbacks know of a search.
struct Search {
  Ranks& ranks;
  const LinearMap& product;
  const LinearMap& precondition;
  double enough, scale;
  EnergyGains gains = {};
  GradientsReport report = {};
  double curvature = 0.0;  ///< p'A p of the last product
  double rz = 0.0, first = 0.0;
};

double dot(Ranks& ranks, std::span<const double> a, std::span<const double> b) {
  double sum = scalar_product(a, b);
  ranks.sum({&sum, 1});
  return sum;
}

/// Numbers of a vector of PETSc that this rank has.
class OwnPart {
 public:
  OwnPart(Vec vector) : vector_(vector) {
    PetscInt size = 0;
    PetscCallAbort(PETSC_COMM_WORLD, VecGetLocalSize(vector, &size));
    PetscCallAbort(PETSC_COMM_WORLD, VecGetArrayRead(vector, &values_));
    size_ = static_cast<std::size_t>(size);
  }
  ~OwnPart() { VecRestoreArrayRead(vector_, &values_); }
  OwnPart(const OwnPart&) = delete;
  OwnPart& operator=(const OwnPart&) = delete;
  operator std::span<const double>() const { return {values_, size_}; }

 private:
  Vec vector_;
  const PetscScalar* values_ = nullptr;
  std::size_t size_ = 0;
};

/// PETSc's frames let no exception pass, and the other ranks would wait.
void apply(Ranks& ranks, const LinearMap& map, std::span<const double> from, Vec to) {
  PetscScalar* values = nullptr;
  PetscCallAbort(PETSC_COMM_WORLD, VecGetArrayWrite(to, &values));
  try {
    map(from, {values, from.size()});
  } catch (const std::exception& error) {
    ranks.abandon(error.what());
  }
  PetscCallAbort(PETSC_COMM_WORLD, VecRestoreArrayWrite(to, &values));
}

PetscErrorCode multiply(Mat matrix, Vec from, Vec to) {
  Search* search = nullptr;
  PetscCall(MatShellGetContext(matrix, &search));
  const OwnPart own(from);
  apply(search->ranks, search->product, own, to);
  search->curvature = dot(search->ranks, own, OwnPart(to));
  return 0;
}

PetscErrorCode precondition(PC preconditioner, Vec from, Vec to) {
  Search* search = nullptr;
  PetscCall(PCShellGetContext(preconditioner, &search));
  apply(search->ranks, search->precondition, OwnPart(from), to);
  return 0;
}

/// The test of perilink::conjugate_gradients(): `norm` is the root of r'z.
PetscErrorCode is_enough(KSP, PetscInt iteration, PetscReal norm, KSPConvergedReason* reason,
                         void* context) {
  Search& search = *static_cast<Search*>(context);
  GradientsReport& report = search.report;
  const double rz = search.rz;
  search.rz = norm * norm;
  *reason = KSP_CONVERGED_ITERATING;
  report.iterations = static_cast<int>(iteration);
  if (iteration == 0) {
    search.first = search.rz;
    if (search.rz > negligible_correction * search.enough * search.enough * search.scale) return 0;
    report.error = norm;
    report.converged = true;
    *reason = KSP_CONVERGED_ATOL;
    return 0;
  }
  const double gain = rz * rz / search.curvature;
  search.gains.add(gain);
  report.energy += gain;
  report.softest = search.first / report.energy;
  report.error = search.gains.error();
  report.converged =
      !(norm > 0.0) ||
      report.error <= search.enough * std::sqrt(std::max(report.energy, search.scale));
  if (report.converged) *reason = KSP_CONVERGED_RTOL;
  return 0;
}

/// Vectors, matrix and method of one search.
struct Objects {
  Mat matrix = nullptr;
  KSP method = nullptr;
  Vec right = nullptr, solution = nullptr;
  ~Objects() {
    KSPDestroy(&method);
    MatDestroy(&matrix);
    VecDestroy(&right);
    VecDestroy(&solution);
  }
};

PetscErrorCode set_up(Objects& objects, Search& search, std::span<const double> right,
                      int most_iterations) {
  const PetscInt size = static_cast<PetscInt>(right.size());
  PetscCall(MatCreateShell(PETSC_COMM_WORLD, size, size, PETSC_DETERMINE, PETSC_DETERMINE, &search,
                           &objects.matrix));
  PetscCall(
      MatShellSetOperation(objects.matrix, MATOP_MULT, reinterpret_cast<void (*)()>(multiply)));
  PetscCall(MatSetOption(objects.matrix, MAT_SPD, PETSC_TRUE));
  PetscCall(MatCreateVecs(objects.matrix, &objects.solution, &objects.right));
  PetscScalar* values = nullptr;
  PetscCall(VecGetArrayWrite(objects.right, &values));
  std::copy(right.begin(), right.end(), values);
  PetscCall(VecRestoreArrayWrite(objects.right, &values));

  PetscCall(KSPCreate(PETSC_COMM_WORLD, &objects.method));
  PetscCall(KSPSetOperators(objects.method, objects.matrix, objects.matrix));
  PetscCall(KSPSetType(objects.method, KSPCG));
  PetscCall(KSPSetTolerances(objects.method, search.enough, PETSC_DEFAULT, PETSC_DEFAULT,
                             most_iterations));
  PC preconditioner = nullptr;
  PetscCall(KSPGetPC(objects.method, &preconditioner));
  PetscCall(PCSetType(preconditioner, PCSHELL));
  PetscCall(PCShellSetContext(preconditioner, &search));
  PetscCall(PCShellSetApply(preconditioner, precondition));
  PetscCall(KSPSetFromOptions(objects.method));
  PetscBool is_cg = PETSC_FALSE;
  PetscCall(PetscObjectTypeCompare(reinterpret_cast<PetscObject>(objects.method), KSPCG, &is_cg));
  if (!is_cg) return 0;
  // The test counts energies by what this form of the method looks at.
  PetscCall(KSPSetNormType(objects.method, KSP_NORM_NATURAL));
  PetscCall(KSPCGUseSingleReduction(objects.method, PETSC_FALSE));
  return KSPSetConvergenceTest(objects.method, is_enough, &search, nullptr);
}

/// Methods that do not count energies: that of the answer, and the root of r'z in place of the
/// error.
void look_at_answer(const Objects& objects, Search& search, std::span<const double> right) {
  const OwnPart answer(objects.solution);
  const std::span<const double> x = answer;
  std::vector<double> r(x.size()), z(x.size());
  search.product(x, r);
  search.report.energy = dot(search.ranks, x, r);
  for (std::size_t k = 0; k < r.size(); ++k) r[k] = right[k] - r[k];
  search.precondition(r, z);
  search.report.error = std::sqrt(std::max(0.0, dot(search.ranks, r, z)));
}

}  // namespace

GradientsReport petsc_gradients(Ranks& ranks, const LinearMap& product,
                                const LinearMap& precondition, std::span<const double> right,
                                std::span<double> solution, double enough, double scale,
                                int most_iterations) {
  Search search{ranks, product, precondition, enough, scale};
  Objects objects;
  PetscCallAbort(PETSC_COMM_WORLD, set_up(objects, search, right, most_iterations));
  PetscCallAbort(PETSC_COMM_WORLD, KSPSolve(objects.method, objects.right, objects.solution));
  KSPConvergedReason reason = KSP_CONVERGED_ITERATING;
  PetscCallAbort(PETSC_COMM_WORLD, KSPGetConvergedReason(objects.method, &reason));
  if (reason == KSP_DIVERGED_INDEFINITE_MAT || reason == KSP_DIVERGED_INDEFINITE_PC ||
      reason == KSP_DIVERGED_NANORINF) {
    throw NotPositiveDefinite("the stiffness is not positive definite");
  }
  if (search.gains.empty() && reason > 0 && !search.report.converged) {  // another method than cg
    PetscInt iterations = 0;
    PetscCallAbort(PETSC_COMM_WORLD, KSPGetIterationNumber(objects.method, &iterations));
    search.report.iterations = static_cast<int>(iterations);
    search.report.converged = true;
    look_at_answer(objects, search, right);
  }
  const OwnPart answer(objects.solution);
  const std::span<const double> x = answer;
  for (std::size_t k = 0; k < x.size(); ++k) solution[k] += x[k];
  return search.report;
}

}  // namespace perilink
