#include "calibration/facet_shares.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <Eigen/Dense>

#include "base/dense/decompositions.hpp"
#include "calibration/bounded_least_squares/killing_fields.hpp"
#include "discretization/facet_geometry.hpp"

namespace perilink {
namespace {

/// Defects below this, relative to the sum of all terms, are round-off and are ignored.
constexpr double balanced = 1e-14;

/// Returns the number of products of three rigid motions.
Eigen::Index count_of_works(const RigidMotions& motions) {
  const int count = motions.count();
  return count * (count + 1) * (count + 2) / 6;
}

/// Returns the work of the boundary forces of all uniform strains at a corner, (delta_ab A_c +
/// delta_ac A_b + delta_bc A_a) : (e f g), on every product e f g of three rigid motions.
Eigen::VectorXd work_on_killing_tensors(const RigidMotions& motions, std::span<const double> x,
                                        std::span<const double> area_vector) {
  Vector3 area{};
  std::copy(area_vector.begin(), area_vector.end(), area.begin());
  const int count = motions.count();
  std::array<Vector3, 6> at;
  std::array<double, 6> along;
  for (int i = 0; i < count; ++i) {
    at[i] = motions.at(i, x);
    along[i] = dot(area, at[i]);
  }
  Eigen::VectorXd work(count_of_works(motions));
  Eigen::Index next = 0;
  for (int i = 0; i < count; ++i) {
    for (int j = i; j < count; ++j) {
      const double product = dot(at[i], at[j]);
      for (int k = j; k < count; ++k) {
        work[next++] =
            product * along[k] + dot(at[i], at[k]) * along[j] + dot(at[j], at[k]) * along[i];
      }
    }
  }
  return work;
}

/// A connected part of the body.
class Part {
 public:
  Part(Facets& facets, std::span<const double> positions, std::span<const double> modulus,
       std::vector<Index> members)
      : facets_(facets), positions_(positions), modulus_(modulus), members_(std::move(members)) {}

  void balance() {
    const RigidMotions motions = make_motions();
    const Eigen::Index rows = count_of_works(motions);
    Eigen::VectorXd defect = Eigen::VectorXd::Zero(rows), size = defect;
    for (const Index f : members_) {
      const Eigen::MatrixXd work = works(motions, f);
      for (Eigen::Index c = 0; c < work.cols(); ++c) {
        defect += shares_of(f)[c] * work.col(c);
        size += shares_of(f)[c] * work.col(c).cwiseAbs();
      }
    }
    if (defect.cwiseAbs().maxCoeff() <= balanced * size.maxCoeff()) return;
    Eigen::MatrixXd gram = Eigen::MatrixXd::Zero(rows, rows);
    for (const Index f : members_) {
      const Eigen::MatrixXd work = gradient(motions, f);
      gram.noalias() += work * work.transpose();
    }
    // 6 of the 56 products in 3D repeat.
    const Eigen::VectorXd multiplier = least_squares<Eigen::VectorXd>(gram, -defect);
    for (const Index f : members_) shares_of(f) += gradient(motions, f).transpose() * multiplier;
  }

 private:
  std::span<const double> position(Index i) const {
    return positions_.subspan(static_cast<std::size_t>(i) * facets_.dim,
                              static_cast<std::size_t>(facets_.dim));
  }

  RigidMotions make_motions() const {
    Vector3 lower{}, upper{};
    bool first = true;
    for (const Index f : members_) {
      for (const Index i : facets_.corners.row(f)) {
        for (int a = 0; a < facets_.dim; ++a) {
          lower[a] = first ? position(i)[a] : std::min(lower[a], position(i)[a]);
          upper[a] = first ? position(i)[a] : std::max(upper[a], position(i)[a]);
        }
        first = false;
      }
    }
    return RigidMotions(facets_.dim, lower, upper);
  }

  /// Returns work, shape (Killing tensors, corners).
  Eigen::MatrixXd works(const RigidMotions& motions, Index f) const {
    const auto corners = facets_.corners.row(f);
    double jump = modulus_[facets_.inside[f]];
    if (!facets_.on_surface(f)) jump -= modulus_[facets_.outside[f]];
    Eigen::MatrixXd result;
    for (std::size_t c = 0; c < corners.size(); ++c) {
      const Eigen::VectorXd work =
          jump * work_on_killing_tensors(motions, position(corners[c]), facets_.area_vector(f));
      if (c == 0) result.resize(work.size(), static_cast<Eigen::Index>(corners.size()));
      result.col(static_cast<Eigen::Index>(c)) = work;
    }
    return result;
  }

  /// Returns the gradient of the work with respect to the corners' area fractions, whose sum is
  /// constant.
  Eigen::MatrixXd gradient(const RigidMotions& motions, Index f) const {
    Eigen::MatrixXd work = works(motions, f);
    work.colwise() -= work.rowwise().mean().eval();
    if (facets_.is_tied(f)) work.setZero();
    return work;
  }

  Eigen::Map<Eigen::VectorXd> shares_of(Index f) {
    const Index begin = facets_.corners.offsets[f];
    return {facets_.shares.data() + begin, facets_.corners.offsets[f + 1] - begin};
  }

  Facets& facets_;
  std::span<const double> positions_;
  std::span<const double> modulus_;
  std::vector<Index> members_;
};

}  // namespace

void balance_shares(Facets& facets, std::span<const double> positions,
                    std::span<const Index> part_of, std::span<const double> modulus) {
  if (facets.size() == 0) return;
  const Index num_parts = 1 + *std::max_element(part_of.begin(), part_of.end());
  std::vector<std::vector<Index>> members(static_cast<std::size_t>(num_parts));
  for (Index f = 0; f < facets.size(); ++f) {
    members[part_of[facets.corners.row(f).front()]].push_back(f);
  }
  for (std::vector<Index>& part : members) {
    Part(facets, positions, modulus, std::move(part)).balance();
  }
}

}  // namespace perilink
