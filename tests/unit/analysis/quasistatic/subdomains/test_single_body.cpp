#include "analysis/quasistatic/subdomains/single_body.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "assembly/block_forces.hpp"
#include "assembly/subdomains/subdomain_stiffness.hpp"
#include "solver/factor_routes.hpp"
#include "support/analysis_bodies.hpp"
#include "support/small_networks.hpp"

namespace perilink {
namespace {

using namespace test;

/// A body in subdomains, with the inputs of its solver.
struct Boxed {
  explicit Boxed(const LatticeCase& lattice, int columns = 6)
      : body(make_block({.lattice = lattice, .columns = columns})) {
    secants = intact(body.network);
    motions.emplace(body.network, secants, body.unknowns, 8);
    SubdomainStiffness stiffness =
        assemble_subdomain_stiffness(body.network, secants, body.unknowns, *motions);
    factor = make_factor(FactorRoute::refactorize, 1);
    std::vector<Index> groups;
    for (Index k = 0; k < stiffness.coarse.rows(); ++k) {
      groups.push_back(k / motions->num_motions());
    }
    factor->factorize(stiffness.coarse, groups);
    const int dim = body.network.dim();
    const std::size_t size = static_cast<std::size_t>(dim) * dim;
    for (std::size_t begin = 0; begin < stiffness.blocks.size(); begin += size) {
      Eigen::Map<Eigen::MatrixXd> block(stiffness.blocks.data() + begin, dim, dim);
      block = block.inverse().eval();
    }
    blocks = std::move(stiffness.blocks);
    order.emplace(*motions, body.network.particles.size());
    const double unit = 3.0 * body.network.stiffness[0];
    bonds =
        std::make_unique<PackedBonds>(body.network, secants, order->place, unit, order->part_end());
    single = std::make_unique<SingleBody>(body.network, body.unknowns, *motions, *order, *bonds,
                                          blocks, *factor);
  }
  /// Numbers of every particle in the order of the body.
  std::vector<float> ordered(const std::vector<double>& values) const {
    const std::size_t row = static_cast<std::size_t>(body.network.dim()) * block_width;
    std::vector<float> result(values.size());
    for (std::size_t k = 0; k < values.size(); ++k) {
      result[bonds->place(static_cast<Index>(k / row)) * row + k % row] =
          static_cast<float>(values[k]);
    }
    return result;
  }
  /// Zero where something is held.
  std::vector<double> motion(int seed) const {
    std::vector<double> values = random_vector(body.unknowns.number.size() * block_width, seed);
    for (std::size_t k = 0; k < values.size(); ++k) {
      if (body.unknowns.number[k / block_width] < 0) values[k] = 0.0;
    }
    return values;
  }
  AnalysisBody body;
  std::vector<double> secants;
  std::optional<SubdomainMotions> motions;
  std::unique_ptr<Factor> factor;
  std::vector<double> blocks;
  std::optional<SubdomainOrder> order;
  std::unique_ptr<PackedBonds> bonds;
  std::unique_ptr<SingleBody> single;
};

/// Seven digits of terms that cancel.
void expect_near(const std::vector<float>& found, const std::vector<float>& expected) {
  float size = 0.0F;
  for (const float value : expected) size = std::max(size, std::abs(value));
  for (std::size_t k = 0; k < found.size(); ++k) ASSERT_NEAR(found[k], expected[k], 1e-5F * size);
}

TEST(SingleBody, MultipliesWithSpringsAsInDoublePrecision) {
  for (const int columns : {6, 16}) {
    Boxed boxed({"", Pattern::cubic, Surface::none}, columns);
    boxed.secants[5] = 0.25;
    const std::vector<double> ground =
        random_vector(static_cast<std::size_t>(boxed.body.unknowns.count), 2);
    boxed.single->follow(boxed.secants, ground);
    const std::vector<double> motion = boxed.motion(3);
    std::vector<double> expected(motion.size());
    block_forces(boxed.body.network, boxed.secants, motion, expected);
    for (std::size_t k = 0; k < motion.size(); ++k) {
      const Index unknown = boxed.body.unknowns.number[k / block_width];
      if (unknown >= 0) expected[k] += ground[unknown] * motion[k];
      expected[k] /= boxed.bonds->unit();
    }
    std::vector<float> found(motion.size());
    boxed.single->multiply(boxed.ordered(motion), found,
                           [](std::size_t, std::size_t, std::size_t) {});
    expect_near(found, boxed.ordered(expected));
  }
}

TEST(SingleBody, PreconditionsByParticlesAndBoxes) {
  for (const Pattern pattern : {Pattern::hexagonal, Pattern::cubic}) {
    // 17 particles along each side are so many that they are taken in parts.
    Boxed boxed({"", pattern, Surface::none}, pattern == Pattern::cubic ? 16 : 6);
    const std::size_t dim = static_cast<std::size_t>(boxed.body.network.dim());
    const std::vector<double> residual = boxed.motion(4);
    std::vector<double> expected(residual.size(), 0.0);
    for (std::size_t k = 0; k < residual.size(); ++k) {
      const std::size_t slot = k / block_width, particle = slot / dim;
      if (boxed.body.unknowns.number[slot] < 0) continue;
      for (std::size_t b = 0; b < dim; ++b) {
        expected[k] += boxed.blocks[slot * dim + b] *
                       residual[(particle * dim + b) * block_width + k % block_width];
      }
    }
    std::vector<double> coarse(static_cast<std::size_t>(boxed.motions->num_subdomains()) *
                               boxed.motions->num_motions() * block_width);
    boxed.motions->restrict_block(residual, coarse);
    boxed.factor->solve_all(coarse);
    boxed.motions->add_block(coarse, expected);
    for (double& value : expected) value *= boxed.bonds->unit();
    std::vector<float> found(residual.size());
    std::vector<std::size_t> complete(most_parts, 0);  // by part
    boxed.single->precondition(boxed.ordered(residual), found,
                               [&](std::size_t part, std::size_t begin, std::size_t end) {
                                 complete[part] += end - begin;
                               });
    EXPECT_EQ(std::accumulate(complete.begin(), complete.end(), std::size_t{0}) * block_width,
              found.size());
    EXPECT_EQ(complete.back() > 0, pattern == Pattern::cubic);
    expect_near(found, boxed.ordered(expected));
  }
}

}  // namespace
}  // namespace perilink
