// tests/unit mirrors src: whoever opens a source file knows where its tests are.

#include <gtest/gtest.h>

#include <map>
#include <string>

#include "quality/source_tree.hpp"

namespace perilink::quality {
namespace {

/// Sources without a unit test of their own, and what tests them instead.
const std::map<std::string, std::string>& tested_elsewhere() {
  static const std::map<std::string, std::string> table = {
      {"app/commands/check_command.cpp", "a command: tests/cli runs the program"},
      {"app/commands/check_conditions.cpp", "a part of check: tests/cli runs the program"},
      {"app/commands/check_sizes.cpp", "a part of check: tests/cli runs the program"},
      {"app/commands/compare_command.cpp", "a command: tests/cli runs the program"},
      {"app/commands/converge_command.cpp", "a command: tests/cli runs the program"},
      {"app/commands/option_texts.cpp", "texts of the program: tests/cli/test_option_texts.cpp"},
      {"app/commands/report_command.cpp", "a command: tests/cli runs the program"},
      {"app/commands/run_command.cpp", "a command: tests/cli runs the program"},
      {"app/commands/scan_command.cpp", "a command: tests/cli runs the program"},
      {"analysis/dynamics/bonds/runs/run_share.cpp", "a part of runs: test_bond_analysis.cpp"},
      {"analysis/dynamics/lattice/rows/paper_forces.cpp", "a row kernel: test_row_kernels.cpp"},
      {"analysis/quasistatic/equilibrium/update/column_update.cpp",
       "an update: test_make_update.cpp"},
      {"analysis/quasistatic/equilibrium/displacement/element_deformations.cpp",
       "energies that events lose: test_weakening.cpp, test_event_batch.cpp"},
      {"analysis/quasistatic/equilibrium/update/factor_update.cpp",
       "an update: test_make_update.cpp"},
      {"analysis/quasistatic/equilibrium/displacement/field.cpp",
       "a part of loads: test_permanent_load.cpp"},
      {"analysis/quasistatic/equilibrium/displacement/growing_load.cpp", "test_equilibrium.cpp"},
      {"analysis/quasistatic/equilibrium/reaction_work.cpp", "test_equilibrium.cpp"},
      {"analysis/quasistatic/equilibrium/displacement/solution.cpp", "test_equilibrium.cpp"},
      {"analysis/quasistatic/subdomains/column_cache.cpp",
       "a part of SubdomainFactor: test_subdomain_factor.cpp"},
      {"analysis/quasistatic/subdomains/subdomain_blocks.cpp",
       "a part of SubdomainSolver: test_subdomain_factor.cpp"},
      {"analysis/quasistatic/ranks/part_solver.cpp", "a part of a team: test_team.cpp"},
      {"calibration/bounded_least_squares/interior_point.cpp", "test_bounded_least_squares.cpp"},
      {"calibration/bounded_least_squares/normal_equations.cpp", "test_bounded_least_squares.cpp"},
      {"model/conditions/idle_forces.cpp", "test_boundary_conditions.cpp"},
      {"calibration/kept/kept_calibration.cpp", "with its store: test_calibration_files.cpp"},
      {"app/main.cpp", "only starts the program; tests/cli runs it"},
      {"app/memory_at_start.cpp", "runs before main: tests/cli/test_memory.cpp"},
      {"app/process/rank_start.cpp", "what mpiexec starts: tests/cli/test_ranks.cpp"},
      {"app/process/serve.cpp", "what ranks wait in: test_team.cpp, test_bond_analysis.cpp"},
      {"app/program.cpp", "only calls the commands; tests/cli runs the program"},
      {"app/scan/scan_run.cpp", "runs processes: tests/cli/test_scan.cpp"},
      {"app/rank_main.cpp", "only starts ranks: tests/cli/test_ranks.cpp"},
      {"assembly/subdomains/subdomain_stiffness.cpp", "test_subdomain_motions.cpp"},
      {"discretization/lattices/lattice_conforming.cpp", "a part of make_body: test_make_body.cpp"},
      {"discretization/lattices/lattice_facets.cpp", "a part of make_body: test_facets.cpp"},
      {"discretization/lattices/lattice_fit.cpp", "a part of make_body: test_make_body.cpp"},
      {"discretization/lattices/lattice_hexagonal.cpp", "a part of make_body: test_make_body.cpp"},
      {"discretization/lattices/lattice_parts.cpp", "parts of make_body: test_make_body.cpp"},
      {"discretization/mesh_faces.cpp", "a part of make_mesh_body: test_mesh_body.cpp"},
      {"io/case/case_page.cpp", "the reference page: tests/quality/test_case_keys.cpp"},
      {"io/case/keys/body_keys.cpp", "tables of keys: tests/quality/test_case_keys.cpp"},
      {"io/case/keys/load_keys.cpp", "tables of keys: tests/quality/test_case_keys.cpp"},
      {"io/case/keys/part_keys.cpp", "tables of keys: tests/quality/test_case_keys.cpp"},
      {"io/case/keys/run_keys.cpp", "tables of keys: tests/quality/test_case_keys.cpp"},
      {"io/mesh/abaqus_lines.cpp", "a part of read_abaqus: test_abaqus_file.cpp"},
      {"io/mesh/abaqus_sets.cpp", "a part of read_abaqus: test_abaqus_file.cpp"},
      {"io/mesh/gmsh_cursor.cpp", "a part of parse_mesh: test_mesh_file.cpp"},
      {"io/mesh/gmsh_sections.cpp", "a part of parse_mesh: test_mesh_file.cpp"},
      {"io/mesh/mesh_listing.cpp", "a part of parse_mesh: test_mesh_file.cpp"},
      {"python/events.cpp", "tests/python"},
      {"python/module.cpp", "tests/python"},
      {"python/problems.cpp", "tests/python"},
      {"python/runs.cpp", "tests/python"},
      {"python/scans.cpp", "tests/python"},
      {"python/time_runs.cpp", "tests/python"},
      {"solver/cholmod_support.cpp", "what the routes share: test_factor_routes.cpp runs them"},
      {"solver/cholmod_updown_factor.cpp", "a route: test_factor_routes.cpp runs every route"},
      {"solver/factor.cpp", "what routes share: test_factor_routes.cpp runs every route"},
      {"solver/ranks/process_ranks.cpp", "what ranks share: tests/cli/test_ranks.cpp"},
      {"solver/ranks/mpi_ranks.cpp", "needs mpiexec: tests/cli/test_ranks.cpp"},
      {"solver/refactorizing_factor.cpp", "a route: test_factor_routes.cpp runs every route"},
  };
  return table;
}

std::filesystem::path unit_test_of(const std::string& source) {
  const std::filesystem::path path = source;
  return project_root() / "tests/unit" / path.parent_path() / ("test_" + path.filename().string());
}

TEST(Mirror, EverySourceHasAUnitTestOrAReason) {
  for (const auto& file : cpp_files("src")) {
    if (file.extension() != ".cpp") continue;
    const std::string source = file.lexically_relative(project_root() / "src").generic_string();
    if (tested_elsewhere().count(source) > 0) continue;
    EXPECT_TRUE(std::filesystem::exists(unit_test_of(source)))
        << shown(file) << ": write " << shown(unit_test_of(source));
  }
}

TEST(Mirror, EveryExceptionIsStillNeeded) {
  for (const auto& [source, reason] : tested_elsewhere()) {
    EXPECT_TRUE(std::filesystem::exists(project_root() / "src" / source)) << source;
    EXPECT_FALSE(std::filesystem::exists(unit_test_of(source))) << source << ": " << reason;
  }
}

TEST(Mirror, EveryUnitTestHasASource) {
  for (const auto& file : cpp_files("tests/unit")) {
    const std::string name = file.filename().string();
    if (name.rfind("test_", 0) != 0) continue;  // helper
    const auto folder = file.parent_path().lexically_relative(project_root() / "tests/unit");
    const auto source = project_root() / "src" / folder / name.substr(5);
    const bool exists =
        std::filesystem::exists(source) ||
        std::filesystem::exists(std::filesystem::path(source).replace_extension("hpp"));
    EXPECT_TRUE(exists) << shown(file) << " tests no " << shown(source);
  }
}

}  // namespace
}  // namespace perilink::quality
