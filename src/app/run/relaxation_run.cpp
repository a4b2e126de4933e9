#include "app/run/relaxation_run.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "analysis/dynamics/fundamental_period.hpp"
#include "app/run/bond_run.hpp"
#include "app/run/run_notes.hpp"
#include "app/run/run_warnings.hpp"
#include "base/plain_text.hpp"

namespace perilink {

RelaxationOptions relaxation_options(const CaseFile& input, int threads) {
  RelaxationOptions options;
  options.load_factors = input.analysis.load_factors;
  options.tolerance = input.analysis.tolerance.value_or(options.tolerance);
  options.most_iterations = input.analysis.iterations;
  options.strain = input.analysis.strain;
  options.threads = threads;
  return options;
}

namespace {

/// A run with type = "relaxation": bonds are brought to static equilibrium by damped motion.
class RelaxationRun final : public MovingBondsRun {
 public:
  RelaxationRun(const CaseFile& of_case, int on_threads, const RunCallbacks& calls)
      : MovingBondsRun(of_case, on_threads, calls) {
    steps_ = static_cast<Index>(input.analysis.load_factors.size());
    constexpr double usual_iterations = 3000.0;  // of a load step
    checkpoint_rows_ = rows_of_time(model_.network.num_elements(), model_.network.particles.size(),
                                    usual_iterations);
    plan += ", " + counted(steps_, "load step");
  }

  void analyse() override {
    result_ = run_dynamic_relaxation(model_, relaxation_options(input, threads), *this,
                                     from_ ? &*from_ : nullptr);
    complete_by_rule(run_outcome());
  }

  RunOutcome run_outcome() override { return {result_.termination, result_.reason}; }

  void tell(Summary& summary) const override {
    const Index broken = result_.last.broken_bonds;
    const EnergyBalance& energy = result_.last.energy;
    tell_peaks(summary, input, files().peaks(), result_.peak_load);
    tell_residual_strength(summary, input, files().peaks());
    summary.add("iterations", result_.iterations);
    summary.add("residual", result_.residual);
    summary.add("displacement_error", result_.error);
    summary.line("iterations", "{}, residual {:.1e}, displacements to {:.1e}", result_.iterations,
                 result_.residual, result_.error);
    summary.add("rows", files().rows());
    summary.add("broken_bonds", broken);
    tell_energies(summary, energy);
    summary.line("energy", "{:.6g} work, {:.6g} dissipated by {}, {:.6g} damped",
                 energy.external_work, energy.fractured, counted(broken, "broken bond"),
                 energy.external_damping);
    tell_cracks(summary, cracks_);
    tell_body(summary, model_);
    summary.add_warnings(warnings_at_rest(result_.last));
    warn_of_motion(summary, false);
    summary.rate = bond_rate(result_.iterations);
    summary.outcome =
        fmt::format("{}, {}, residual {:.2e}", counted(result_.iterations, "iteration"),
                    counted(broken, "broken bond"), result_.residual);
  }

 private:
  RelaxationResult result_;
};

}  // namespace

std::unique_ptr<RunKind> make_relaxation_run(const CaseFile& input, int threads,
                                             const RunCallbacks& calls) {
  return std::make_unique<RelaxationRun>(input, threads, calls);
}

}  // namespace perilink
