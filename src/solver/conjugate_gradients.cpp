#include "solver/conjugate_gradients.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>
#include <vector>

#include "solver/not_positive_definite.hpp"

namespace perilink {

double scalar_product(std::span<const double> first, std::span<const double> second) {
  return std::inner_product(first.begin(), first.end(), second.begin(), 0.0);
}

namespace {

/// a += factor b
void add(double factor, std::span<const double> b, std::span<double> a) {
  for (std::size_t k = 0; k < a.size(); ++k) a[k] += factor * b[k];
}

/// Solution at the last correction, with its exact product. Later directions stay conjugate to it,
/// because rounding errors are largest along soft motions, which dominate a solution.
class KnownSolution {
 public:
  explicit KnownSolution(const ScalarProduct& dot) : dot_(dot) {}

  /// Stores the solution and rescales it along itself.
  /// \param residual  exact residual of the solution; reduced by the rescaling
  void remember(std::span<const double> right, std::span<double> solution,
                std::span<double> residual) {
    motion_.assign(solution.begin(), solution.end());
    forces_.assign(right.begin(), right.end());
    add(-1.0, residual, forces_);
    energy_ = dot_(motion_, forces_);
    if (!(energy_ > 0.0)) return;
    const double share = dot_(motion_, residual) / energy_;
    add(share, motion_, solution);
    add(-share, forces_, residual);
  }
  void make_conjugate(std::span<double> direction) const {
    if (energy_ > 0.0) add(-dot_(forces_, direction) / energy_, motion_, direction);
  }

 private:
  const ScalarProduct& dot_;
  std::vector<double> motion_, forces_;
  double energy_ = 0.0;
};

/// Records one step.
/// \param first  r'z of the right side
void count_step(double gain, double first, EnergyGains& gains, GradientsReport& report) {
  gains.add(gain);
  report.energy += gain;
  report.softest = first / report.energy;
  report.error = gains.error();
  ++report.iterations;
}

/// p <- z + share p
void renew(std::span<const double> z, double share, std::span<double> p) {
  for (std::size_t k = 0; k < p.size(); ++k) p[k] = z[k] + share * p[k];
}

}  // namespace

GradientsReport conjugate_gradients(const LinearMap& product, const LinearMap& precondition,
                                    std::span<const double> right, std::span<double> solution,
                                    double enough, double scale, int most_iterations,
                                    const ScalarProduct& dot, const Correction& correct,
                                    double too_soft) {
  const std::size_t size = right.size();
  GradientsReport report;
  std::vector<double> r(right.begin(), right.end()), z(size), p(size), q(size);
  EnergyGains gains;
  KnownSolution known(dot);
  const auto allowed = [&] { return enough * std::sqrt(std::max(report.energy, scale)); };
  precondition(r, z);
  p = z;
  double rz = dot(r, z), rp = rz;
  const double first = rz;
  // Error at the last exact residual, and the part of it that rounding may have added since.
  double corrected_at = std::sqrt(rz), rounding = 0.1 * digits_between_corrections;
  if (rz <= negligible_correction * enough * enough * scale) {
    report.error = std::sqrt(rz);
    report.converged = true;
    return report;
  }
  while (rz > 0.0 && report.iterations < most_iterations) {
    product(p, q);
    const double curvature = dot(p, q);
    if (!(curvature > 0.0)) throw NotPositiveDefinite("the stiffness is not positive definite");
    const double step = rp / curvature;
    add(step, p, solution);
    add(-step, q, r);
    count_step(step * rp, first, gains, report);
    const bool is_exact = !correct.find_residual || rounding * corrected_at <= allowed();
    report.converged = report.error <= allowed() && is_exact;
    if (report.converged || report.softest < too_soft) return report;
    precondition(r, z);
    const double next = dot(r, z), seemed = std::sqrt(next);
    if (!correct.find_residual ||
        (seemed >= digits_between_corrections * corrected_at && report.error > allowed())) {
      renew(z, next / rz, p);
      known.make_conjugate(p);
      rp = rz = next;
      continue;
    }
    correct.find_residual(solution, r);
    if (correct.keeps_solution) known.remember(right, solution, r);
    precondition(r, z);
    rz = dot(r, z);
    const double before = std::exchange(corrected_at, std::sqrt(rz));
    if (!(corrected_at < least_gain_of_digits * before)) return report;
    rounding = std::max(rounding, (corrected_at - seemed) / before);
    renew(z, -dot(q, z) / curvature, p);  // conjugate to the last direction for any residual
    known.make_conjugate(p);
    rp = dot(p, r);
  }
  report.converged = !(rz > 0.0);
  return report;
}

}  // namespace perilink
