#pragma once

#include <Eigen/Dense>

#include <cmath>
#include <random>
#include <vector>

#include "solver/factor.hpp"

/// \file
/// Small symmetric positive definite matrices with the structure of a bond network, made with the
/// solver module only. A square lattice of particles has springs to all neighbours within a radius,
/// and a spring from every particle to ground.

namespace perilink::test {

struct SpringLattice {
  Index size = 0;
  SparseMatrix lower;
  std::vector<Index> groups;
  std::vector<SparseVector> springs;  ///< vector x of every spring: K = sum x x' + ground

  Eigen::MatrixXd dense() const { return Eigen::MatrixXd(lower).selfadjointView<Eigen::Lower>(); }
};

inline SpringLattice make_spring_lattice(int columns, int rows, double radius,
                                         double ground = 1e-3) {
  SpringLattice lattice;
  lattice.size = 2 * columns * rows;
  std::vector<Eigen::Triplet<double, Index>> entries;
  std::mt19937_64 random(7);  // fixed: one matrix in all runs
  std::uniform_real_distribution<double> stiffness(0.5, 1.5);
  for (Index k = 0; k < lattice.size; ++k) {
    entries.emplace_back(k, k, ground);
    lattice.groups.push_back(k / 2);
  }
  for (int i = 0; i < columns * rows; ++i) {
    for (int j = i + 1; j < columns * rows; ++j) {
      const double dx = j % columns - i % columns, dy = j / columns - i / columns;
      const double length = std::hypot(dx, dy);
      if (length > radius) continue;
      const double root = std::sqrt(stiffness(random) / length);
      SparseVector x;
      x.rows = {2 * i, 2 * i + 1, 2 * j, 2 * j + 1};
      x.values = {-root * dx / length, -root * dy / length, root * dx / length, root * dy / length};
      for (int a = 0; a < 4; ++a) {
        for (int b = 0; b <= a; ++b) {
          entries.emplace_back(x.rows[a], x.rows[b], x.values[a] * x.values[b]);
        }
      }
      lattice.springs.push_back(x);
    }
  }
  lattice.lower.resize(lattice.size, lattice.size);
  lattice.lower.setFromTriplets(entries.begin(), entries.end());
  return lattice;
}

inline std::vector<double> random_vector(Index size, unsigned seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> value(-1.0, 1.0);
  std::vector<double> result(static_cast<std::size_t>(size));
  for (double& v : result) v = value(random);
  return result;
}

inline double relative_difference(const std::vector<double>& a, const std::vector<double>& b) {
  double difference = 0.0, size = 0.0;
  for (std::size_t k = 0; k < a.size(); ++k) {
    difference = std::max(difference, std::abs(a[k] - b[k]));
    size = std::max(size, std::abs(b[k]));
  }
  return difference / size;
}

/// Reorders rows and columns; order[k] is the index that comes k-th.
inline SparseMatrix reordered(const SparseMatrix& lower, const std::vector<Index>& order) {
  Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, Index> place(lower.cols());
  for (Index k = 0; k < static_cast<Index>(order.size()); ++k) place.indices()[order[k]] = k;
  SparseMatrix result(lower.rows(), lower.cols());
  result.selfadjointView<Eigen::Lower>() = lower.selfadjointView<Eigen::Lower>().twistedBy(place);
  return SparseMatrix(result.transpose()).transpose();  // sorts the rows of every column
}

}  // namespace perilink::test
