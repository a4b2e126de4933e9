#pragma once

#include <filesystem>
#include <string>

#include "analysis/quasistatic/event_run.hpp"
#include "app/process/threads.hpp"
#include "app/program.hpp"
#include "app/run/bond_run.hpp"
#include "app/run/quasistatic.hpp"
#include "app/run/relaxation_run.hpp"
#include "app/run/run_case.hpp"
#include "app/scan/calibration_files.hpp"
#include "app/scan/scan_run.hpp"
#include "assembly/fields.hpp"
#include "base/build_info.hpp"
#include "base/error.hpp"
#include "discretization/bonds.hpp"
#include "io/case/case_file.hpp"
#include "io/case/sections/case_kinds.hpp"
#include "io/fields/vtu.hpp"
#include "io/text/csv.hpp"
#include "model/from_case/configure.hpp"
#include "model/from_case/separated_body.hpp"
#include "model/gauges.hpp"
#include "model/model_regions.hpp"
#include "model/reactions.hpp"
#include "results/case_json_schema.hpp"
#include "results/history_columns.hpp"
#include "results/result_directory.hpp"
#include "results/state_file.hpp"

/// \file
/// Public interface of the library (find_package(perilink), target perilink::perilink):
///
///     const CaseFile input = read_case("beam.toml");          // or parse_case(text, path)
///     const RunEnd end = run_case(input, "results/beam");     // as `perilink run`, with files
///
///     const Model model = build(input);                       // particles, bonds, loads
///     const ElasticAnswer answer = solve(input, model);       // without files
///
///     const DamageOptions options = damage_options(input, 1);
///     EventRun run(model, options);                           // event by event
///     while (const StepRecord* row = run.next()) ...          // run.state(), run.save()
///
///     const BondRunCase moving = build_bond_run(input, model);        // explicit
///     run_explicit_bonds(model, moving.inertia, moving.rules, moving.options, observer);
///
///     ScanFile scan = read_scan_file("scan.toml");            // as `perilink scan`
///     const std::vector<CaseFile> cases = read_members(scan, {});
///     ScanSettings settings{"results/scan"};
///     settings.program = "/usr/bin/perilink";                 // of the members
///     run_scan(scan, cases, settings);
///
/// set_threads() sets the number of threads of all later work. Errors are exceptions: InputError,
/// FileError and SolverError. Functions may not be called from several threads at once.

namespace perilink {

/// Reads and checks a case.
/// \throws InputError  with file, line, key, value given, what is allowed and a suggestion
/// \throws FileError   when the file cannot be read
inline CaseFile read_case(const std::string& path) { return read_case_file(path); }

/// Builds particles, bonds, supports and loads of a case.
/// \throws InputError where the case does not fit its body
inline Model build(const CaseFile& input, const CalibrationCalls& calibration = {}) {
  return build_model(input, calibration);
}

/// Solves for the elastic equilibrium at load factor 1, whatever the analysis type of the case;
/// with stages under the loads of the first.
/// \throws SolverError when the stiffness matrix is not positive definite
inline ElasticAnswer solve(const CaseFile& input, const Model& model, int threads = 1) {
  const ElasticOptions options = elastic_options(input, threads);
  if (is_quasistatic(input.analysis.type) || model.elements) return solve_elastic(model, options);
  Model still = model;  // runs over time have no unknowns for embedded points, nor follow them
  carry_embedded_points(still.network, still.unknowns);
  return solve_elastic(still, options);
}

}  // namespace perilink
