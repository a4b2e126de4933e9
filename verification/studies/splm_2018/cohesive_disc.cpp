#include "cohesive_disc.hpp"

#include <Eigen/Dense>
#include <Eigen/Sparse>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <vector>

namespace perilink::verification {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using Number = Eigen::Index;

/// Nodes of a quarter, (cells + 1)^2, row after row from the horizontal diameter to the platen:
/// the unit square drawn onto the quarter disc, with a node at the end of the platen.
struct Quarter {
  Number side = 0;  ///< nodes along a side
  std::vector<double> x, y;

  Quarter(const CohesiveDisc& disc, int cells) : side(cells + 1) {
    const double end = std::numbers::sqrt2 * disc.half_platen / disc.radius;
    const int under = static_cast<int>(std::lround(cells * end));
    if (under < 1 || under >= cells) {
      throw std::invalid_argument("the elements of the cohesive disc do not fit its platens");
    }
    for (int j = 0; j <= cells; ++j) {
      for (int i = 0; i <= cells; ++i) {
        const double a =
            i <= under ? end * i / under : end + (1.0 - end) * (i - under) / (cells - under);
        const double b = 1.0 * j / cells;
        x.push_back(disc.radius * a * std::sqrt(1.0 - 0.5 * b * b));
        y.push_back(disc.radius * b * std::sqrt(1.0 - 0.5 * a * a));
      }
    }
  }
  Number node(Number i, Number j) const { return j * side + i; }
};

using Element = Eigen::Matrix<double, 8, 8>;

/// Two Gauss points per direction.
Element element_stiffness(const Quarter& mesh, const std::array<Number, 4>& nodes,
                          const Eigen::Matrix3d& moduli, double thickness) {
  constexpr std::array<double, 4> corner_x = {-1.0, 1.0, 1.0, -1.0};
  constexpr std::array<double, 4> corner_y = {-1.0, -1.0, 1.0, 1.0};
  const double gauss = 1.0 / std::numbers::sqrt3;
  Element stiffness = Element::Zero();
  for (int point = 0; point < 4; ++point) {
    const double s = gauss * corner_x[point], t = gauss * corner_y[point];
    Eigen::Matrix<double, 2, 4> slope;
    Eigen::Matrix<double, 4, 2> position;
    for (int n = 0; n < 4; ++n) {
      slope(0, n) = 0.25 * corner_x[n] * (1.0 + t * corner_y[n]);
      slope(1, n) = 0.25 * corner_y[n] * (1.0 + s * corner_x[n]);
      position.row(n) << mesh.x[nodes[n]], mesh.y[nodes[n]];
    }
    const Eigen::Matrix2d jacobian = slope * position;
    const Eigen::Matrix<double, 2, 4> gradient = jacobian.inverse() * slope;
    Eigen::Matrix<double, 3, 8> strain = Eigen::Matrix<double, 3, 8>::Zero();
    for (int n = 0; n < 4; ++n) {
      strain(0, 2 * n) = strain(2, 2 * n + 1) = gradient(0, n);
      strain(1, 2 * n + 1) = strain(2, 2 * n) = gradient(1, n);
    }
    stiffness += thickness * jacobian.determinant() * strain.transpose() * moduli * strain;
  }
  return stiffness;
}

Eigen::SparseMatrix<double> assemble(const CohesiveDisc& disc, const Quarter& mesh) {
  const double nu = disc.poissons_ratio, scale = disc.youngs_modulus / (1.0 - nu * nu);
  Eigen::Matrix3d moduli;
  moduli << scale, nu * scale, 0.0, nu * scale, scale, 0.0, 0.0, 0.0, 0.5 * (1.0 - nu) * scale;
  std::vector<Eigen::Triplet<double>> entries;
  for (Number j = 0; j + 1 < mesh.side; ++j) {
    for (Number i = 0; i + 1 < mesh.side; ++i) {
      const std::array<Number, 4> nodes = {mesh.node(i, j), mesh.node(i + 1, j),
                                           mesh.node(i + 1, j + 1), mesh.node(i, j + 1)};
      const Element element = element_stiffness(mesh, nodes, moduli, disc.thickness);
      for (int a = 0; a < 8; ++a) {
        for (int b = 0; b < 8; ++b) {
          entries.emplace_back(2 * nodes[a / 2] + a % 2, 2 * nodes[b / 2] + b % 2, element(a, b));
        }
      }
    }
  }
  const Number size = 2 * mesh.side * mesh.side;
  Eigen::SparseMatrix<double> matrix(size, size);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

/// Stiffness seen by the horizontal displacements of the vertical diameter, and last by the
/// vertical displacement of the platen; the horizontal diameter slides along itself.
MatrixXd condense(const CohesiveDisc& disc, const Quarter& mesh) {
  const Eigen::SparseMatrix<double> matrix = assemble(disc, mesh);
  constexpr int held = -1, inner = -2;
  std::vector<int> kind(matrix.rows(), inner);
  const auto last = static_cast<int>(mesh.side);
  for (Number i = 0; i < mesh.side; ++i) {
    kind[2 * mesh.node(i, 0) + 1] = held;
    kind[2 * mesh.node(0, i)] = static_cast<int>(i);
    const Number top = mesh.node(i, mesh.side - 1);
    if (mesh.x[top] <= disc.half_platen * (1.0 + 1e-12)) kind[2 * top + 1] = last;
  }
  std::vector<Number> number(matrix.rows(), 0);
  Number count = 0;
  for (Number k = 0; k < matrix.rows(); ++k) {
    if (kind[k] == inner) number[k] = count++;
  }
  std::vector<Eigen::Triplet<double>> entries;
  MatrixXd coupling = MatrixXd::Zero(count, last + 1);
  MatrixXd own = MatrixXd::Zero(last + 1, last + 1);
  for (Number column = 0; column < matrix.cols(); ++column) {
    for (Eigen::SparseMatrix<double>::InnerIterator it(matrix, column); it; ++it) {
      const int row_kind = kind[it.row()], column_kind = kind[column];
      if (row_kind == held || column_kind == held) continue;
      if (row_kind == inner && column_kind == inner) {
        entries.emplace_back(number[it.row()], number[column], it.value());
      } else if (row_kind == inner) {
        coupling(number[it.row()], column_kind) += it.value();
      } else if (column_kind != inner) {
        own(row_kind, column_kind) += it.value();
      }
    }
  }
  Eigen::SparseMatrix<double> free(count, count);
  free.setFromTriplets(entries.begin(), entries.end());
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factor(free);
  return own - coupling.transpose() * factor.solve(coupling);
}

struct Traction {
  double stress = 0.0, slope = 0.0;  ///< over the opening
};
Traction traction(const CrackOpeningLaw& law, double opening) {
  const double knee = law.knee_ratio * law.strength;
  if (opening < law.knee_opening) {
    const double slope = (knee - law.strength) / law.knee_opening;
    return {law.strength + slope * opening, slope};
  }
  if (opening >= law.critical_opening) return {};
  const double slope = -knee / (law.critical_opening - law.knee_opening);
  return {slope * (opening - law.critical_opening), slope};
}

/// The crack between two halves that mirror each other: half of its opening at each node. Up to the
/// peak none closes again, so the law needs no unloading.
class Crack {
 public:
  Crack(const CohesiveDisc& disc, const Quarter& mesh)
      : law_(disc.law), stiffness_(condense(disc, mesh)) {
    const Number nodes = mesh.side;
    half_ = VectorXd::Zero(nodes);
    area_ = VectorXd::Zero(nodes);
    for (Number i = 0; i + 1 < nodes; ++i) {
      const double length = mesh.y[mesh.node(0, i + 1)] - mesh.y[mesh.node(0, i)];
      area_[i] += 0.5 * disc.thickness * length;
      area_[i + 1] += 0.5 * disc.thickness * length;
    }
    open_.assign(nodes, false);
  }

  /// Newton's method for the nodes that have opened.
  /// \returns whether there is an equilibrium near the last one
  bool load(double platen) {
    constexpr int most = 100;
    constexpr double smallest = 1e-15;  // round-off; openings are about a micrometre [m]
    for (int iteration = 0; iteration < most; ++iteration) {
      const VectorXd pull = pulls(platen);
      std::vector<Number> active;
      for (Number i = 0; i < half_.size(); ++i) {
        open_[i] = open_[i] || pull[i] > law_.strength * area_[i];
        if (open_[i]) active.push_back(i);
      }
      if (active.empty()) return true;
      const auto size = static_cast<Number>(active.size());
      MatrixXd tangent(size, size);
      VectorXd rest(size);
      for (Number a = 0; a < size; ++a) {
        const Traction here = traction(law_, 2.0 * half_[active[a]]);
        rest[a] = pull[active[a]] - here.stress * area_[active[a]];
        for (Number b = 0; b < size; ++b) tangent(a, b) = stiffness_(active[a], active[b]);
        tangent(a, a) += 2.0 * here.slope * area_[active[a]];
      }
      const VectorXd step = tangent.partialPivLu().solve(rest);
      for (Number a = 0; a < size; ++a) {
        const Number i = active[a];
        half_[i] = std::max(0.0, half_[i] + step[a]);
        open_[i] = half_[i] > 0.0;
      }
      if (step.lpNorm<Eigen::Infinity>() < smallest) return true;
    }
    return false;
  }

  /// Both quarters under a platen.
  double force(double platen) const {
    const Number last = half_.size();
    return 2.0 *
           std::abs(stiffness_.row(last).head(last).dot(half_) + stiffness_(last, last) * platen);
  }
  double opening() const { return 2.0 * half_.maxCoeff(); }
  /// See SplittingLoad::error.
  double error(double platen) const {
    const VectorXd pull = pulls(platen);
    double largest = 0.0;
    for (Number i = 0; i < half_.size(); ++i) {
      if (!open_[i]) continue;
      const double difference = pull[i] / area_[i] - traction(law_, 2.0 * half_[i]).stress;
      largest = std::max(largest, std::abs(difference) / law_.strength);
    }
    return largest;
  }
  /// Displacement of the platen at which the diameter first has the strength.
  double first_displacement() const {
    const Number last = half_.size();
    const VectorXd stress = -stiffness_.col(last).head(last).cwiseQuotient(area_);
    return -law_.strength / -stress.minCoeff();
  }

 private:
  /// Tension of the diameter times the area of each node.
  VectorXd pulls(double platen) const {
    const Number last = half_.size();
    return -(stiffness_.topLeftCorner(last, last) * half_ +
             stiffness_.col(last).head(last) * platen);
  }

  CrackOpeningLaw law_;
  MatrixXd stiffness_;
  VectorXd half_, area_;
  std::vector<bool> open_;
};

}  // namespace

SplittingLoad splitting_load(const CohesiveDisc& disc, int cells) {
  constexpr int steps = 1000;  // platen steps up to the first crack
  Crack crack(disc, Quarter(disc, cells));
  const double first = crack.first_displacement();
  SplittingLoad found;
  found.first_crack = found.peak = crack.force(first);
  found.displacement = std::abs(first);
  for (int step = steps + 1; step < 5 * steps; ++step) {
    const double platen = first * step / steps;
    found.sudden = !crack.load(platen);
    if (found.sudden) return found;
    const double force = crack.force(platen);
    if (force < found.peak) return found;
    found.peak = force;
    found.displacement = std::abs(platen);
    found.opening = crack.opening();
    found.error = crack.error(platen);
  }
  throw std::runtime_error("the cohesive disc has no peak");
}

}  // namespace perilink::verification
