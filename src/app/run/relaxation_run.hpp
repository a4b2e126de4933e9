#pragma once

#include <filesystem>

#include "analysis/dynamics/bonds/dynamic_relaxation.hpp"
#include "app/run/bond_run.hpp"

namespace perilink {

/// Options of a case with type = "relaxation".
RelaxationOptions relaxation_options(const CaseFile& input, int threads);

/// About as many iterations as the first load step takes: until the slowest vibration, damped
/// critically, has decayed to the tolerance.
double expected_iterations(const Model& model, const RelaxationOptions& options);

/// Writes DIR/summary.json. \throws FileError
void write_summary(const std::filesystem::path& directory, const CaseFile& input,
                   const Model& model, const RelaxationResult& result, const BondRunFiles& files,
                   const PhaseSeconds& seconds, int threads);

/// The same for people, on standard output.
void print_summary(const std::filesystem::path& directory, const CaseFile& input,
                   const Model& model, const RelaxationResult& result, const BondRunFiles& files,
                   const PhaseSeconds& seconds);

}  // namespace perilink
