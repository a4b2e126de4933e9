#include "analysis/quasistatic/events/dozing_columns.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "analysis/quasistatic/events/limit_search.hpp"
#include "support/analysis_bodies.hpp"

namespace perilink {
namespace {

using namespace test;

/// A block of columns that move the particles near one end of the body, and hardly the others.
std::vector<double> columns_near(const Network& network, unsigned seed) {
  std::vector<double> columns = random_vector(
      network.particles.positions.size() * static_cast<std::size_t>(block_width), seed);
  for (std::size_t k = 0; k < columns.size(); ++k) {
    const std::size_t particle = k / static_cast<std::size_t>(block_width * network.dim());
    columns[k] *= std::exp(-3.0 * network.particles.position(static_cast<Index>(particle))[0]);
  }
  return columns;
}

/// A search that follows a motion by columns, and what it should find.
struct Followed {
  explicit Followed(const LatticeCase& lattice)
      : body(make_block({lattice})), search(body.network), whole(body.network) {
    const std::size_t size = body.network.particles.positions.size();
    displacement = current = random_vector(size, 1);
    for (std::size_t slot = 0; slot < size; ++slot) {
      if (body.unknowns.number[slot] != no_index) solution.push_back(current[slot]);
    }
    motion.unknowns = &body.unknowns;
    motion.solution = &solution;
    motion.displacement = &displacement;
    motion.blocks = &blocks;
    add_block(2);
    EXPECT_TRUE(search.doze_by_columns(motion));
  }
  void add_block(unsigned seed) {
    const std::vector<double> columns = columns_near(body.network, seed);
    blocks.emplace_back(columns.begin(), columns.end());
    for (std::size_t k = 0; k < blocks.back().size(); ++k) {
      if (body.unknowns.number[k / block_width] == no_index) blocks.back()[k] = 0.0;
    }
    motion.steps.resize(blocks.size() * block_width, 0.0);
    motion.moved.resize(motion.steps.size(), 0.0);
  }
  void step(std::size_t column, double size) {
    motion.steps[column] += size;
    motion.moved[column] += std::abs(size);
    ++motion.changes;
    const BlockVector<double>& block = blocks[column / block_width];
    for (std::size_t slot = 0; slot < current.size(); ++slot) {
      current[slot] += size * block[slot * block_width + column % block_width];
    }
  }
  /// Whether both find the same, to round-off of the displacements.
  void expect_same() {
    const BreakSearch::Hit hit = search.find(displacement, 1e-12, 1);
    const BreakSearch::Hit expected = whole.find(current, 1e-12, 1);
    ASSERT_EQ(hit.element, expected.element);
    EXPECT_NEAR(hit.ratio, expected.ratio, 1e-12 * expected.ratio);
  }
  AnalysisBody body;
  LimitSearch search, whole;
  std::vector<double> solution, displacement, current;
  std::vector<BlockVector<double>> blocks;
  DeferredMotion motion;
};

const LatticeCase lattices[] = {{"", Pattern::hexagonal, Surface::none},
                                {"", Pattern::cubic, Surface::none}};

TEST(DozingColumns, FindWhatASearchAmongAllFinds) {
  for (const LatticeCase& lattice : lattices) {
    Followed followed(lattice);
    followed.expect_same();
    for (int k = 0; k < 60; ++k) {
      if (k == 20) followed.add_block(3);
      const std::size_t columns = followed.motion.steps.size();
      followed.step(static_cast<std::size_t>(7 * k) % columns, 0.05 * std::sin(1.0 + 2.0 * k));
      followed.expect_same();
      if (k % 10 != 9) continue;
      const Index failed = followed.whole.find(followed.current, 1e-12, 1).element;
      for (LimitSearch* search : {&followed.search, &followed.whole}) {
        search->set_limit(failed, k % 20 == 9 ? INFINITY : 1e-3);  // higher and lower ones
      }
      followed.expect_same();
    }
  }
}

/// Elsewhere displacements stay those of earlier events.
TEST(DozingColumns, LeaveMotionOutWhereNothingCanBreak) {
  Followed followed(lattices[1]);
  const auto stretched = static_cast<std::size_t>(followed.body.network.bonds.first[0]) * 3;
  for (std::vector<double>* u : {&followed.displacement, &followed.current}) {
    (*u)[stretched] += 1e3;  // one bond far ahead of all others
  }
  if (const Index k = followed.body.unknowns.number[stretched]; k != no_index) {
    followed.solution[k] += 1e3;
  }
  followed.expect_same();
  followed.step(0, 1.0);
  const std::vector<double> before = followed.displacement;
  followed.expect_same();
  std::size_t moved = 0;
  for (std::size_t k = 0; k < before.size(); ++k) moved += before[k] != followed.displacement[k];
  EXPECT_GT(moved, 0U);
  EXPECT_LT(moved, before.size() / 2);
}

TEST(DozingColumns, BeginAnewWhereTheSolutionOrTheColumnsHaveChanged) {
  Followed followed(lattices[0]);
  followed.expect_same();
  for (double& value : followed.current) value *= -1.0;
  for (double& value : followed.solution) value *= -1.0;
  followed.displacement = followed.current;
  ++followed.motion.restarts;
  followed.expect_same();
  followed.blocks.clear();
  followed.motion.steps.clear();
  followed.motion.moved.clear();
  ++followed.motion.renewals;
  followed.add_block(9);
  followed.step(3, 0.5);
  followed.expect_same();
}

}  // namespace
}  // namespace perilink
