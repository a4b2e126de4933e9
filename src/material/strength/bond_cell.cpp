#include "material/strength/bond_cell.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace perilink {
namespace {

using CellStrain = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 6, 1>;
using Stiffness = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 6, 6>;

/// Bonds whose ratios differ by less are symmetry-equivalent and have their events together.
constexpr double alike_in_cell = 1e-9;

/// A cell has failed at this fraction of its intact stiffness.
constexpr double failed = 1e-3;

/// Directions of isotropic_cell(): over a half circle in the plane, and over a half sphere about x
/// in space. The sphere has equal steps of the angle to the axis, so that some directions are close
/// to it.
constexpr int plane_directions = 60, polar_directions = 16, directions_around = 5;

/// Smallest squared ratio of axial to equivalent stretch that counts as tension, as in the event
/// search.
constexpr double least_cell_tension = 1e-12;

/// Returns the symmetric product of two vectors as a vector of components. Shear components have a
/// factor of sqrt(2), so that dot products equal tensor products.
CellStrain vector_of(const Vector3& a, const Vector3& b, int dim) {
  const double half = std::sqrt(0.5);
  if (dim == 2) {
    return Eigen::Vector3d(a[0] * b[0], a[1] * b[1], half * (a[0] * b[1] + a[1] * b[0]));
  }
  CellStrain result(6);
  result << a[0] * b[0], a[1] * b[1], a[2] * b[2], half * (a[1] * b[2] + a[2] * b[1]),
      half * (a[2] * b[0] + a[0] * b[2]), half * (a[0] * b[1] + a[1] * b[0]);
  return result;
}

/// A cell with bonds that lose stiffness.
class Cell {
 public:
  Cell(std::span<const CellBond> bonds, int dim, const Vector3& pull, Across across = Across::free)
      : bonds_(bonds), across_(across), pull_(vector_of(pull, pull, dim)) {
    const auto size = pull_.size();
    for (const CellBond& bond : bonds) {
      const CellStrain axial = vector_of(bond.direction, bond.direction, dim);
      // Square of the strain times the direction.
      Stiffness square = Stiffness::Zero(size, size);
      for (int a = 0; a < dim && bond.shear_ratio > 0.0; ++a) {
        Vector3 axis{};
        axis[a] = 1.0;
        const CellStrain row = vector_of(axis, bond.direction, dim);
        square += row * row.transpose();
      }
      axial_.push_back(axial);
      square_.push_back((1.0 - bond.shear_ratio) * axial * axial.transpose() +
                        bond.shear_ratio * square);
    }
    secants_.assign(bonds.size(), 1.0);
    lost_axial_.assign(bonds.size(), 0.0);
  }

  /// Computes the strain per unit of stress. \return false if the cell has failed
  bool solve() {
    Stiffness sum = Stiffness::Zero(pull_.size(), pull_.size());
    for (std::size_t b = 0; b < bonds_.size(); ++b) {
      if (secants_[b] > 0.0) sum += secants_[b] * bonds_[b].weight * square_[b];
      if (!(lost_axial_[b] > 0.0)) continue;
      const double lost = lost_axial_[b] * bonds_[b].weight;
      sum -= lost * axial_[b] * axial_[b].transpose();
    }
    if (across_ == Across::held) {
      strain_ = pull_ / pull_.dot(sum * pull_);
    } else {
      const Eigen::LDLT<Stiffness> factor(sum);
      if (factor.info() != Eigen::Success || !(factor.vectorD().minCoeff() > 0.0)) return false;
      strain_ = factor.solve(pull_);
    }
    const double softness = pull_.dot(strain_);
    if (intact_ == 0.0) intact_ = softness;
    return softness > 0.0 && softness * failed < intact_;
  }

  double intact_softness() const { return intact_; }
  double softness() const { return pull_.dot(strain_); }
  /// Returns the equivalent stretch of a bond per unit of stress, zero in compression
  /// [length^2/force].
  double stretch(std::size_t bond) const {
    const double axial = axial_[bond].dot(strain_);
    const double square = strain_.dot(square_[bond] * strain_);
    return axial > 0.0 && axial * axial > least_cell_tension * square ? std::sqrt(square) : 0.0;
  }
  /// Returns the axial stretch of a bond per unit of stress [length^2/force].
  double axial_stretch(std::size_t bond) const { return axial_[bond].dot(strain_); }
  void set_secant(std::size_t bond, double secant) { secants_[bond] = secant; }
  /// Sets the axial secant of a bond with shear retention.
  void set_axial_secant(std::size_t bond, double secant) {
    secants_[bond] = secant > 0.0 ? 1.0 : 0.0;
    lost_axial_[bond] = secant > 0.0 ? 1.0 - secant : 0.0;
  }

 private:
  std::span<const CellBond> bonds_;
  Across across_;
  CellStrain pull_, strain_;
  std::vector<CellStrain> axial_;
  std::vector<Stiffness> square_;
  std::vector<double> secants_;
  std::vector<double> lost_axial_;  ///< fraction of the axial stiffness lost before the rest
  double intact_ = 0.0;
};

/// Bonds of one law and their present segments.
class CellBonds {
 public:
  CellBonds(std::size_t count, const BondLaw& law, double critical_stretch)
      : law_(law), critical_(critical_stretch), segment_(count, 0) {}

  /// Returns the stretch over the limit of the next event, per unit of stress [length^2/force].
  double ratio(const Cell& cell, std::size_t bond, double sign) const {
    if (!law_.crushes())
      return sign * cell.stretch(bond) / (critical_ * law_.segment(segment_[bond]).limit);
    const double stretch = sign * cell.axial_stretch(bond) / critical_;
    const int segment = segment_[bond];
    if (stretch > 0.0) return segment < 0 ? 0.0 : stretch / law_.segment(segment).limit;
    if (segment > 0 || !awake_) return 0.0;
    return -stretch / (segment == 0 ? law_.first_in_compression() : law_.segment(segment)).limit;
  }
  void pass(Cell& cell, std::size_t bond, double sign) {
    const bool compressed = law_.crushes() && sign * cell.axial_stretch(bond) < 0.0;
    segment_[bond] = BondLaw::after(segment_[bond], compressed);
    awake_ = awake_ || !compressed;
    const double secant = law_.segment(segment_[bond]).secant;
    law_.keeps_shear() ? cell.set_axial_secant(bond, secant) : cell.set_secant(bond, secant);
  }

 private:
  const BondLaw& law_;
  double critical_;
  std::vector<int> segment_;
  bool awake_ = false;
};

}  // namespace

std::vector<CellBond> lattice_cell(std::span<const Vector3> offsets, std::span<const double> axial,
                                   std::span<const double> shear_ratio, double cell_volume) {
  std::vector<CellBond> cell;
  for (std::size_t k = 0; k < offsets.size(); ++k) {
    const auto& [x, y, z] = offsets[k];
    const bool first_of_pair = std::array{z, y, x} > Vector3{};
    if (!first_of_pair) continue;
    const double length = std::hypot(x, y, z);
    cell.push_back({{x / length, y / length, z / length},
                    axial[k] * length * length / cell_volume,
                    shear_ratio.empty() ? 0.0 : shear_ratio[k]});
  }
  return cell;
}

std::vector<CellBond> isotropic_cell(Problem problem, double lame_ratio) {
  const int dim = dimension_of(problem);
  const double shear = dim == 2 ? (1.0 - lame_ratio) / (1.0 + lame_ratio)
                                : 2.0 * (1.0 - lame_ratio) / (2.0 + 3.0 * lame_ratio);
  // Bonds without bending are equivalent at every length. Otherwise the shells have equal shares of
  // the stiffness, which grows with length^(dim + 1).
  const int shells = shear > 1e-12 ? 3 : 1;
  const auto shell_end = [&](int k) {
    return std::pow(static_cast<double>(k) / shells, (dim - 1.0) / (dim + 1.0));
  };
  std::vector<CellBond> cell;
  const auto add = [&](const Vector3& direction, double share) {
    for (int k = 0; k < shells; ++k) {
      cell.push_back(
          {direction, share / shells, shear * shells * (shell_end(k + 1) - shell_end(k))});
    }
  };
  if (dim == 2) {
    for (int i = 0; i < plane_directions; ++i) {
      const double angle = (i + 0.5) * std::numbers::pi / plane_directions;
      add({std::cos(angle), std::sin(angle), 0.0}, 1.0 / plane_directions);
    }
    return cell;
  }
  const double step = 0.5 * std::numbers::pi / polar_directions;
  for (int i = 0; i < polar_directions; ++i) {
    const double x = std::cos((i + 0.5) * step), across = std::sin((i + 0.5) * step);
    const double share = std::cos(i * step) - std::cos((i + 1) * step);  // between two cones
    for (int k = 0; k < directions_around; ++k) {
      const double angle = (k + 0.5) * 2.0 * std::numbers::pi / directions_around;
      add({x, across * std::cos(angle), across * std::sin(angle)}, share / directions_around);
    }
  }
  return cell;
}

double cell_modulus(std::span<const CellBond> bonds, int dim, const Vector3& pull) {
  Cell cell(bonds, dim, pull);
  return cell.solve() ? 1.0 / cell.intact_softness() : 0.0;
}

double cell_strength(std::span<const CellBond> bonds, int dim, const Vector3& pull,
                     const BondLaw& law) {
  Cell cell(bonds, dim, pull);
  std::vector<int> segment(bonds.size(), 0);
  std::vector<double> ratio(bonds.size());
  double strength = 0.0;
  while (cell.solve()) {
    for (std::size_t b = 0; b < bonds.size(); ++b) {
      ratio[b] = cell.stretch(b) / law.segment(segment[b]).limit;
    }
    const double largest = *std::max_element(ratio.begin(), ratio.end());
    if (!(largest > 0.0)) break;
    strength = std::max(strength, 1.0 / largest);
    for (std::size_t b = 0; b < bonds.size(); ++b) {
      if (ratio[b] >= (1.0 - alike_in_cell) * largest)
        cell.set_secant(b, law.segment(++segment[b]).secant);
    }
  }
  return strength * cell.intact_softness();
}

std::vector<CellPoint> cell_path(std::span<const CellBond> bonds, int dim, const CellDrive& drive,
                                 const BondLaw& law, double critical_stretch) {
  Cell cell(bonds, dim, drive.direction, drive.across);
  CellBonds states(bonds.size(), law, critical_stretch);
  const double sign = drive.compressed ? -1.0 : 1.0;
  std::vector<double> ratio(bonds.size());
  std::vector<CellPoint> path;
  while (cell.solve()) {
    for (std::size_t b = 0; b < bonds.size(); ++b) ratio[b] = states.ratio(cell, b, sign);
    const double largest = *std::max_element(ratio.begin(), ratio.end());
    if (!(largest > 0.0)) break;
    path.push_back({cell.softness() / largest, 1.0 / largest});
    for (std::size_t b = 0; b < bonds.size(); ++b) {
      if (ratio[b] >= (1.0 - alike_in_cell) * largest) states.pass(cell, b, sign);
    }
  }
  return path;
}

double stress_at(std::span<const CellPoint> path, double strain) {
  const auto next = std::find_if(path.begin(), path.end(),
                                 [&](const CellPoint& point) { return point.strain >= strain; });
  if (next == path.end()) return std::numeric_limits<double>::quiet_NaN();
  return strain * next->stress / next->strain;
}

}  // namespace perilink
