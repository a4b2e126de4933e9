#include "app/results/field_pieces.hpp"

#include <gtest/gtest.h>

#include <array>
#include <filesystem>
#include <map>

#include "app/process/serve.hpp"
#include "app/run/quasistatic.hpp"
#include "assembly/results/stress.hpp"
#include "base/error.hpp"
#include "support/strip_case.hpp"
#include "support/temporary_directory.hpp"
#include "support/thread_ranks.hpp"

namespace perilink {
namespace {

namespace fs = std::filesystem;

/// A strip without surface correction, as elastic case.
CaseFile strip_for_ranks() {
  CaseFile input = test::strip_case();
  input.body.surface = Surface::none;
  input.analysis.type = AnalysisType::elastic;
  return input;
}

ElasticAnswer answer_by(Ranks& ranks, const Model& model) {
  ElasticOptions options;
  options.boxes = {.tolerance = 1e-12, .ranks = &ranks};
  return solve_elastic(model, options);
}

/// Rows of the fields of points, by position; directions have any sign.
std::map<std::vector<double>, std::vector<double>> rows_by_position(const VtuGrid& grid) {
  std::map<std::vector<double>, std::vector<double>> rows;
  for (std::size_t i = 0; i < grid.points.size() / 3; ++i) {
    const auto at = grid.points.begin() + static_cast<std::ptrdiff_t>(3 * i);
    std::vector<double>& row = rows[{at, at + 3}];
    for (const VtuArray& array : grid.point_data) {
      if (array.name.ends_with("_direction")) continue;
      const auto first = array.values.begin() + static_cast<std::ptrdiff_t>(i * array.components);
      row.insert(row.end(), first, first + array.components);
    }
  }
  return rows;
}

TEST(FieldPieces, HoldTheFieldsOfTheWholeBody) {
  const CaseFile input = strip_for_ranks();
  const Model whole = build_model(input), shared = build_model(input, {}, 3);
  ASSERT_TRUE(shared.pattern);
  const ElasticAnswer alone = solve_elastic(whole, {});
  const FieldMoment moment{1, 0, 1.0, 12.0, 10.0};
  const Csr neighbourhoods =
      bonds_of_particles(whole.network.bonds, whole.network.particles.size());
  const std::vector<double> intact(static_cast<std::size_t>(whole.network.num_elements()), 1.0);
  const std::vector<double>& u = alone.solution.displacement;
  VtuGrid expected = make_field_grid(whole.network, intact, u, moment, {}, neighbourhoods);
  add_stresses(expected,
               particle_stresses({whole.network, neighbourhoods, whole.problem, whole.hooke}, u),
               2);
  const test::TemporaryDirectory folder;
  const std::string stem = (folder / "fields_000001").string();
  test::with_thread_ranks(
      3,
      [&](Ranks& ranks) {
        const ElasticAnswer answer = answer_by(ranks, shared);
        write_pieces(*answer.solution.team, stem, {moment, shared.problem, shared.hooke});
        dismiss(ranks);
      },
      serve);
  const VtuGrid found = read_vtu(stem + ".pvtu");
  EXPECT_EQ(found.field_data, expected.field_data);
  EXPECT_EQ(found.types, expected.types);
  ASSERT_EQ(found.point_data.size(), expected.point_data.size());
  const auto rows = rows_by_position(found);
  for (const auto& [position, row] : rows_by_position(expected)) {
    const auto own = rows.find(position);
    ASSERT_NE(own, rows.end());
    // Displacements by a factor and to 1e-12 in energy; stresses are some 10, strains some 1e-3.
    for (std::size_t k = 0; k < row.size(); ++k) EXPECT_NEAR(own->second[k], row[k], 1e-8) << k;
  }
}

TEST(FieldPieces, TellWhichRankCouldNotWrite) {
  const Model shared = build_model(strip_for_ranks(), {}, 2);
  const test::TemporaryDirectory folder;
  const fs::path stem = folder / "fields_000001";
  fs::create_directories(stem.string() + "_0001.vtu/occupied");
  test::with_thread_ranks(
      2,
      [&](Ranks& ranks) {
        const ElasticAnswer answer = answer_by(ranks, shared);
        try {
          write_pieces(*answer.solution.team, stem.string(), {{}, shared.problem, shared.hooke});
          ADD_FAILURE() << "written";
        } catch (const SolverError& error) {
          EXPECT_NE(std::string(error.what()).find("_0001.vtu"), std::string::npos);
        }
        dismiss(ranks);
      },
      serve);
  EXPECT_FALSE(fs::exists(stem.string() + ".pvtu"));
}

}  // namespace
}  // namespace perilink
