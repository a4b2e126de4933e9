#include "calibration/bounded_least_squares/killing_fields.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <random>
#include <span>
#include <vector>

#include <Eigen/Dense>

#include "calibration/bond_equations.hpp"

namespace perilink {
namespace {

using Eigen::MatrixXd;

/// Points at random, or on a line, each joined to all others by bonds without moments; equations of
/// different length.
struct UnstructuredParticles {
  UnstructuredParticles(int dim, Index count, bool on_line = false) {
    const ForceRows form{dim, false};
    equations.dim = dim;
    equations.rows = equations.odd = form.count();
    std::mt19937 random(7);
    const auto number = [&] { return static_cast<double>(random()) / 4294967296.0; };
    for (Index p = 0; p < count; ++p) {
      for (int a = 0; a < dim; ++a) {
        equations.positions.push_back(on_line && a > 0 ? 0.5 : 3.0 + number());
      }
      for (int r = 0; r < equations.rows; ++r) equations.scale.push_back(0.5 + number());
    }
    equations.right.assign(equations.scale.size(), 0.0);
    points.resize(static_cast<std::size_t>(count));
    std::iota(points.begin(), points.end(), 0);
    join_all(form);
  }

  void join_all(const ForceRows& form) {
    const std::size_t dim = static_cast<std::size_t>(form.dim), rows = equations.rows;
    const std::size_t count = points.size();
    matrix = MatrixXd::Zero(static_cast<Eigen::Index>(count * (count - 1) / 2),
                            static_cast<Eigen::Index>(count * rows));
    Eigen::Index bond = 0;
    std::vector<double> n(dim), row(rows);
    for (std::size_t p = 0; p < count; ++p) {
      for (std::size_t q = p + 1; q < count; ++q, ++bond) {
        double square = 0.0;
        for (std::size_t a = 0; a < dim; ++a) {
          n[a] = equations.positions[q * dim + a] - equations.positions[p * dim + a];
          square += n[a] * n[a];
        }
        for (double& component : n) component /= std::sqrt(square);
        form.axial(1.0, n, row.data());
        for (std::size_t r = 0; r < rows; ++r) {
          matrix(bond, static_cast<Eigen::Index>(p * rows + r)) =
              row[r] * equations.scale[p * rows + r];
          matrix(bond, static_cast<Eigen::Index>(q * rows + r)) =
              -row[r] * equations.scale[q * rows + r];
        }
      }
    }
  }

  PointEquations equations;
  std::vector<Index> points;
  MatrixXd matrix;  // A', shape (bonds, points * rows)
};

/// As many as there are vectors that all bonds together leave alone: none is missing.
TEST(KillingFields, AreAllThatNoBondFeels) {
  for (const int dim : {2, 3}) {
    const UnstructuredParticles particle_set(dim, dim == 2 ? 16 : 40);
    const MatrixXd fields = killing_fields(particle_set.equations, particle_set.points);
    EXPECT_EQ(fields.cols(), dim == 2 ? 10 : 50);
    EXPECT_LT((particle_set.matrix * fields).cwiseAbs().maxCoeff(), 1e-11);  // round-off
    Eigen::FullPivLU<MatrixXd> all(particle_set.matrix);
    all.setThreshold(1e-9);
    EXPECT_EQ(all.dimensionOfKernel(), fields.cols());
    // Squares down to 1e-10 of the largest were divided by: 1e-16 / 1e-10.
    EXPECT_LT((fields.transpose() * fields - MatrixXd::Identity(fields.cols(), fields.cols()))
                  .cwiseAbs()
                  .maxCoeff(),
              1e-5);
  }
}

/// The turn about a line does not move its points: products of the five other motions are 35, and
/// five of them repeat, with (motion along y) (turn about y) + (along z) (turn about z) = 0.
TEST(KillingFields, AreFewerOnALine) {
  const UnstructuredParticles particle_set(3, 40, true);
  const MatrixXd fields = killing_fields(particle_set.equations, particle_set.points);
  EXPECT_EQ(fields.cols(), 30);
  EXPECT_LT((particle_set.matrix * fields).cwiseAbs().maxCoeff(), 1e-9);
}

TEST(KillingFields, OfOnePointAreItsTensors) {
  const UnstructuredParticles particle_set(3, 5);
  EXPECT_EQ(killing_fields(particle_set.equations, std::span(particle_set.points).first(1)).cols(),
            10);
}

/// An equation that is switched off has no part in any field.
TEST(KillingFields, LeaveOutWhatIsSwitchedOff) {
  UnstructuredParticles particle_set(2, 16);
  particle_set.equations.scale[5] = 0.0;
  const MatrixXd fields = killing_fields(particle_set.equations, particle_set.points);
  EXPECT_EQ(fields.row(5).norm(), 0.0);
  EXPECT_TRUE(fields.allFinite());
}

}  // namespace
}  // namespace perilink
