#include "discretization/calibration.hpp"

#include <algorithm>
#include <cmath>
#include <memory>

#include "discretization/calibration_report.hpp"
#include "discretization/coarse_space.hpp"
#include "discretization/facet_shares.hpp"
#include "discretization/least_change.hpp"
#include "discretization/surface_columns.hpp"
#include "discretization/variable_parts.hpp"

namespace perilink {
namespace {

/// Forces out of balance above this are told to the user. Round-off leaves up to 1e-8 along boundaries of
/// some hundred spacings.
constexpr double met = 1e-7;

/// Where a bond may fall to zero, it is on its way there below this weight.
constexpr double vanishing = 1e-3;
/// Zeros stay where they bring the forces out of balance down to this part.
constexpr double worth_dropping = 0.1;

/// In irregular clouds the energies of dilatation are soft equations: squares weigh 1 / ridge against those of
/// the changes. Few digits are enough; what the exact forces move afterwards is more. In space the forces beside
/// them are a little soft too: at edges and corners positive weights often cannot do both.
constexpr double dilatation_ridge = 0.03;
constexpr double forces_ridge_in_space = 1e-4;
constexpr double settling_tolerance = 0.01;

/// Moments are soft: together with the forces they are nearly singular (docs/theory/calibration.md).
constexpr double moments_ridge = 1e-4;

/// Intermediate passes need no more digits; what they leave is no contradiction.
constexpr double coarse_tolerance = 1e-6, coarsely_met = 1e-4;

class Calibration {
 public:
  Calibration(const CalibrationInput& input, const CalibrationOptions& options, Facets& facets,
              BondStiffness& stiffness)
      : input_(input),
        options_(options),
        facets_(facets),
        stiffness_(stiffness),
        start_(stiffness),
        given_(stiffness),
        dim_(input.particles.dim),
        forces_{dim_, !stiffness.bending.empty()} {}

  CalibrationReport run();

 private:
  bool solve(const LeastChangeOptions& forces, CalibrationReport& report);
  bool allow_zero(double limit);
  bool hollow() const;
  void restore();
  bool attempt(const LeastChangeOptions& forces, CalibrationReport& report);
  void drop_vanishing();
  bool is_free(Index b) const { return input_.free.empty() || input_.free[b] != 0; }
  void choose_points();
  void measure_particles();
  PointEquations make_equations(const ForceRows& rows) const;
  PointEquations force_equations(const ForceRows& rows, bool moments) const;
  PointEquations settling_equations() const;
  void gather_dilatations(PointEquations& equations) const;
  void settle(const PointEquations& equations, double tolerance, CalibrationReport& report);
  bool balance(const LeastChangeOptions& options, CalibrationReport& report);
  int improve(const PointEquations& equations, const LeastChangeOptions& options);
  void report_balance(CalibrationReport& report) const;
  std::vector<double> out_of_balance() const;

  const CalibrationInput& input_;
  const CalibrationOptions& options_;
  Facets& facets_;
  BondStiffness& stiffness_;
  BondStiffness start_;        // zero for bonds that were dropped
  const BondStiffness given_;  // all of them
  int dim_;
  ForceRows forces_;
  std::vector<Index> point_of_;     // of each particle, no_index where no free bond ends
  std::vector<Index> particle_of_;  // of each point
  std::vector<Index> free_bonds_;
  /// Bonds with a variable in the equations: first for axial stiffness, then for bending.
  std::vector<Index> variables_[2];
  std::vector<std::uint8_t> may_vanish_;  // bonds without a lower bound
  std::vector<double> modulus_;      // 1/2 sum k xi^2 of each particle at the start
  std::vector<double> length_;       // mean xi of each particle
  bool energies_ = false;            // of dilatation take part
  std::unique_ptr<CoarseSpace> factor_;  // of the force equations
};

void Calibration::choose_points() {
  const Index num_particles = input_.particles.size();
  std::vector<std::uint8_t> touched(static_cast<std::size_t>(num_particles), 0);
  for (Index b = 0; b < input_.bonds.size(); ++b) {
    if (!is_free(b)) continue;
    free_bonds_.push_back(b);
    touched[input_.bonds.first[b]] = touched[input_.bonds.second[b]] = 1;
  }
  variables_[0] = free_bonds_;
  if (!stiffness_.bending.empty()) variables_[1] = free_bonds_;
  point_of_.assign(static_cast<std::size_t>(num_particles), no_index);
  for (Index i = 0; i < num_particles; ++i) {
    if (!touched[i]) continue;
    point_of_[i] = static_cast<Index>(particle_of_.size());
    particle_of_.push_back(i);
  }
}

void Calibration::measure_particles() {
  const std::size_t count = static_cast<std::size_t>(input_.particles.size());
  modulus_.assign(count, 0.0);
  length_.assign(count, 0.0);
  std::vector<double> forces(count, 0.0);
  const Bonds& bonds = input_.bonds;
  for (Index b = 0; b < bonds.size(); ++b) {
    const double force = start_.axial[b] * bonds.lengths[b];
    for (const Index i : {bonds.first[b], bonds.second[b]}) {
      modulus_[i] += 0.5 * force * bonds.lengths[b];
      forces[i] += 0.5 * force;
    }
  }
  for (std::size_t i = 0; i < count; ++i) {
    if (forces[i] > 0.0) length_[i] = modulus_[i] / forces[i];
  }
}

/// Variables, coefficients and bounds; right sides and scales are left to the caller.
PointEquations Calibration::make_equations(const ForceRows& rows) const {
  PointEquations equations;
  equations.dim = dim_;
  equations.rows = rows.count();
  equations.odd = rows.odd();
  const Bonds& bonds = input_.bonds;
  std::vector<double> row(static_cast<std::size_t>(rows.count()));
  for (const bool bending : {false, true}) {
    const std::vector<double>& present = bending ? stiffness_.bending : stiffness_.axial;
    const std::vector<double>& start = bending ? start_.bending : start_.axial;
    for (const Index b : variables_[bending]) {
      equations.first.push_back(point_of_[bonds.first[b]]);
      equations.second.push_back(point_of_[bonds.second[b]]);
      rows.fill(bonds.lengths[b], bonds.direction(b), bending, row.data());
      for (const double value : row) equations.coefficients.push_back(present[b] * value);
      equations.lower.push_back(
          may_vanish_[b] ? 0.0
                         : std::min(1.0, options_.least_weight * start[b] / present[b]));
    }
  }
  for (const Index i : particle_of_) {
    const auto x = input_.particles.position(i);
    equations.positions.insert(equations.positions.end(), x.begin(), x.end());
  }
  return equations;
}

/// Shape (particles, rows of forces_).
std::vector<double> Calibration::out_of_balance() const {
  return forces_out_of_balance(forces_, facets_, input_.materials, input_.bonds, stiffness_.axial,
                               stiffness_.bending, input_.particles.size());
}

/// Right sides of the dilatation are left to the caller.
PointEquations Calibration::force_equations(const ForceRows& form, bool moments) const {
  PointEquations equations = make_equations(form);
  const std::size_t rows = static_cast<std::size_t>(form.count());
  const std::size_t known = static_cast<std::size_t>(forces_.count());
  // What the bonds that stay leave to be done: the rest, and what the free bonds carry now.
  const std::vector<double> rest = out_of_balance();
  for (const Index i : particle_of_) {
    for (std::size_t r = 0; r < rows; ++r) {
      equations.right.push_back(r < known ? rest[i * known + r] : 0.0);
      const bool moment = static_cast<int>(r) >= form.odd();
      const double arm = !moment ? length_[i] : moments && r < known ? 1.0 : 0.0;
      equations.scale.push_back(arm / modulus_[i]);
    }
  }
  for (Index v = 0; v < equations.num_variables(); ++v) {
    const double* a = equations.coefficients.data() + v * rows;
    double* first = equations.right.data() + equations.first[v] * rows;
    double* second = equations.right.data() + equations.second[v] * rows;
    for (std::size_t r = 0; r < known; ++r) {
      first[r] += a[r];
      second[r] += static_cast<int>(r) < form.odd() ? -a[r] : a[r];
    }
  }
  if (moments) {
    equations.ridge.assign(rows, moments_ridge);
    std::fill_n(equations.ridge.begin(), form.odd(), 0.0);
  }
  return equations;
}

/// Forces and the energies of dilatation, of columns under the surface and of the particles inside.
PointEquations Calibration::settling_equations() const {
  PointEquations equations = force_equations({dim_, forces_.bending, true}, false);
  equations.ridge.assign(static_cast<std::size_t>(equations.rows), 0.0);
  if (dim_ == 3) std::fill_n(equations.ridge.begin(), forces_.odd(), forces_ridge_in_space);
  equations.ridge.back() = dilatation_ridge;
  gather_dilatations(equations);
  return equations;
}

void Calibration::gather_dilatations(PointEquations& equations) const {
  const std::vector<Index> head = surface_columns(input_.bonds, facets_, input_.particles);
  const std::size_t rows = static_cast<std::size_t>(equations.rows);
  for (const Index i : particle_of_) {
    const Index group = point_of_[head[i] == no_index ? i : head[i]];
    equations.group.push_back(group);
    equations.right[(group + 1) * rows - 1] +=
        dilatation_modulus(dim_, input_.particles.volumes[i],
                           input_.materials[input_.particles.material[i]]);
  }
  scale_last_rows(equations);
  for (std::size_t p = 0; p < particle_of_.size(); ++p) {
    if (head[particle_of_[p]] == no_index) equations.scale[(p + 1) * rows - 1] = 0.0;
  }
}

/// \return iterations
int Calibration::improve(const PointEquations& equations, const LeastChangeOptions& options) {
  const LeastChange change = least_change(equations, options, factor_);
  auto weight = change.weights.begin();
  for (const Index b : variables_[0]) stiffness_.axial[b] *= *weight++;
  for (const Index b : variables_[1]) stiffness_.bending[b] *= *weight++;
  return change.iterations;
}

void Calibration::report_balance(CalibrationReport& report) const {
  report_forces(forces_, out_of_balance(), modulus_, length_, met, report);
}

/// Takes the lower bound from the bonds of particles that are out of balance by more than the limit.
/// \return whether there was a bound to take
bool Calibration::allow_zero(double limit) {
  const std::vector<double> rest = out_of_balance();
  const std::size_t rows = static_cast<std::size_t>(forces_.count());
  bool any = false;
  const auto unmet = [&](Index i) {
    const auto forces = rest.begin() + static_cast<std::ptrdiff_t>(i * rows);
    return std::any_of(forces, forces + forces_.odd(), [&](double force) {
      return std::abs(force) * length_[i] > limit * modulus_[i];
    });
  };
  for (const Index b : free_bonds_) {
    if (may_vanish_[b] || (!unmet(input_.bonds.first[b]) && !unmet(input_.bonds.second[b]))) continue;
    may_vanish_[b] = 1;
    any = true;
  }
  return any;
}

/// Takes what has fallen to zero out of the equations. Where weights must be exactly zero no multiplier
/// brings them there, only nearer and nearer.
void Calibration::drop_vanishing() {
  for (const bool bending : {false, true}) {
    const std::vector<double>& present = bending ? stiffness_.bending : stiffness_.axial;
    std::vector<double>& start = bending ? start_.bending : start_.axial;
    std::vector<Index> kept;
    for (const Index b : variables_[bending]) {
      if (may_vanish_[b] && present[b] < vanishing * start[b]) {
        start[b] = 0.0;
      } else {
        kept.push_back(b);
      }
    }
    variables_[bending] = std::move(kept);
  }
}

/// What is soft: energies of dilatation, or moments.
void Calibration::settle(const PointEquations& equations, double tolerance, CalibrationReport& report) {
  LeastChangeOptions options;
  options.tolerance = tolerance;
  if (input_.free.empty()) options.preconditioner = Preconditioner::aggregates;
  factor_.reset();  // coefficients are those of the stiffnesses now
  report.iterations += improve(equations, options);
  factor_.reset();
}

/// The forces, exactly. Where no positive weights balance many particles the search diverges; then the settled
/// stiffnesses are kept. \return whether forces are nearer to balance now
bool Calibration::balance(const LeastChangeOptions& options, CalibrationReport& report) {
  report_balance(report);
  const double before = report.residual_after;
  const BondStiffness settled = stiffness_;
  report.iterations += improve(force_equations(forces_, false), options);
  report_balance(report);
  if (report.residual_after <= std::max(met, before)) return true;
  stiffness_ = settled;
  report_balance(report);
  return false;
}

bool Calibration::solve(const LeastChangeOptions& forces, CalibrationReport& report) {
  stiffness_ = start_;
  if (energies_) settle(settling_equations(), settling_tolerance, report);
  if (stiffness_.bending.empty()) return balance(forces, report);
  // Exact forces unsettle the moments of clouds: twice.
  for (int pass = 0; pass < (input_.free.empty() ? 2 : 1); ++pass) {
    settle(force_equations(forces_, true), coarse_tolerance, report);
    if (!balance(forces, report)) return false;
  }
  return true;
}

/// Whether a particle has lost more than half of its bonds.
bool Calibration::hollow() const {
  std::vector<Index> kept_minus_lost(static_cast<std::size_t>(input_.particles.size()), 0);
  for (Index b = 0; b < input_.bonds.size(); ++b) {
    const Index vote = stiffness_.axial[b] > 0.0 ? 1 : -1;
    for (const Index i : {input_.bonds.first[b], input_.bonds.second[b]}) kept_minus_lost[i] += vote;
  }
  return std::any_of(kept_minus_lost.begin(), kept_minus_lost.end(), [](Index n) { return n < 0; });
}

/// Back to all bonds and their lower bounds.
void Calibration::restore() {
  start_ = given_;
  variables_[0] = free_bonds_;
  if (!stiffness_.bending.empty()) variables_[1] = free_bonds_;
  std::fill(may_vanish_.begin(), may_vanish_.end(), 0);
}

/// With zeros where forces are out of balance without. Where zeros do not help (too few neighbours all over)
/// every bond keeps something to carry. \return whether the exact forces led anywhere
bool Calibration::attempt(const LeastChangeOptions& forces, CalibrationReport& report) {
  const bool cautious = dim_ == 3;  // corners may have no solution: finding out takes few digits
  LeastChangeOptions coarse = forces;
  if (cautious) coarse.tolerance = coarse_tolerance;
  if (!solve(coarse, report)) return false;
  const double floored = report.residual_after;
  if (allow_zero(cautious ? coarsely_met : met)) {
    solve(coarse, report);
    drop_vanishing();
    solve(forces, report);
    if (report.residual_after <= worth_dropping * floored && !hollow()) return true;
    restore();
    solve(forces, report);
  } else if (cautious) {
    balance(forces, report);
  }
  return true;
}

CalibrationReport Calibration::run() {
  CalibrationReport report;
  choose_points();
  measure_particles();
  may_vanish_.assign(static_cast<std::size_t>(input_.bonds.size()), 0);
  std::vector<double> lambda;
  for (const LameConstants& material : input_.materials) lambda.push_back(material.lambda);
  const std::vector<Index> part_of = connected_parts(input_.bonds, input_.particles.size());
  balance_shares(facets_, input_.particles.positions, part_of, lambda);
  report.free_bonds = static_cast<Index>(free_bonds_.size());
  report_balance(report);
  report.residual_before = report.residual_after;
  LeastChangeOptions forces;
  forces.tolerance = options_.tolerance;
  forces.preconditioner = dim_ == 2              ? Preconditioner::factor
                          : input_.free.empty() ? Preconditioner::aggregates
                                                : Preconditioner::blocks_then_factor;
  // In space energies and moments get in each other's way (verification/studies/patch_tests).
  energies_ = input_.free.empty() && (dim_ == 2 || stiffness_.bending.empty());
  if (!attempt(forces, report) && energies_) {
    const BondStiffness settled = stiffness_;
    const double reached = report.residual_after;
    energies_ = false;
    attempt(forces, report);
    if (report.residual_after > reached) {
      restore();
      stiffness_ = settled;
      report_balance(report);
    }
  }
  for (const Index b : free_bonds_) {
    if (stiffness_.axial[b] == 0.0) {
      ++report.dropped;
      if (!stiffness_.bending.empty()) stiffness_.bending[b] = 0.0;
      continue;
    }
    const double weight = stiffness_.axial[b] / start_.axial[b];
    report.at_least_weight += weight <= 1.000001 * options_.least_weight;
    report.smallest_weight = std::min(report.smallest_weight, weight);
    report.largest_weight = std::max(report.largest_weight, weight);
  }
  return report;
}

}  // namespace

CalibrationReport calibrate_bonds(const CalibrationInput& input, const CalibrationOptions& options,
                                  Facets& facets, BondStiffness& stiffness) {
  return Calibration(input, options, facets, stiffness).run();
}

}  // namespace perilink
