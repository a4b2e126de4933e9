#include "app/run/relaxation_run.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "analysis/dynamics/fundamental_period.hpp"

namespace perilink {

RelaxationOptions relaxation_options(const CaseFile& input, int threads) {
  RelaxationOptions options;
  options.load_factors = input.analysis.load_factors;
  options.tolerance = input.analysis.tolerance;
  options.most_iterations = input.analysis.iterations;
  options.strain = strain_of(input.analysis);
  options.threads = threads;
  return options;
}

double expected_iterations(const Model& model, const RelaxationOptions& options) {
  const Inertia inertia = fictitious_inertia(model.network, options.strain);
  const double period = fundamental_period(model.network, model.unknowns, inertia);
  const double step = options.safety * inertia.critical_time_step();
  return -std::log(options.tolerance) * period / (2.0 * std::numbers::pi * step);
}

RelaxationRun::RelaxationRun(const CaseFile& input, int threads, bool quiet)
    : RunKind(input, threads), model_(build_model_visibly(input, quiet)) {
  take_notes(model_);
  plan = fmt::format("{}, {} load steps", size_text(model_), input.analysis.load_factors.size());
}

RunFiles& RelaxationRun::open(const std::filesystem::path& directory, bool quiet) {
  const auto steps = static_cast<Index>(input_.analysis.load_factors.size());
  return observer_.emplace(input_, model_, steps, directory, quiet);
}

std::string RelaxationRun::outcome() const {
  return fmt::format("{} iterations, {} broken bonds, residual {:.2e}", result_.iterations,
                     result_.last.broken_bonds, result_.residual);
}

void RelaxationRun::tell(Summary& summary) const {
  const EnergyBalance& energy = result_.last.energy;
  tell_peaks(summary, input_, observer_->peaks(), result_.peak_load);
  summary.add("iterations", result_.iterations);
  summary.add("residual", result_.residual);
  summary.add("displacement_error", result_.error);
  summary.line("iterations", "{}, residual {:.1e}, displacements to {:.1e}", result_.iterations,
               result_.residual, result_.error);
  summary.add("rows", observer_->rows());
  summary.add("broken_bonds", result_.last.broken_bonds);
  tell_energies(summary, energy);
  summary.line("energy", "{:.6g} work, {:.6g} dissipated by {} broken bonds, {:.6g} damped",
               energy.external_work, energy.fractured, result_.last.broken_bonds,
               energy.external_damping);
  tell_body(summary, model_);
}

std::string RelaxationRun::rate() const {
  return rate_text(1.0 * model_.network.num_elements() * result_.iterations, seconds.analysis,
                   "bond-steps");
}

}  // namespace perilink
