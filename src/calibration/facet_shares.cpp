#include "calibration/facet_shares.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Dense>

#include "calibration/least_change/killing_fields.hpp"
#include "discretization/facet_geometry.hpp"

namespace perilink {
namespace {

/// Defects below this, relative to the sum of all terms, are round-off and change nothing.
constexpr double balanced = 1e-14;

/// Work of the boundary forces of all uniform strains at a corner, (delta_ab A_c + delta_ac A_b +
/// delta_bc A_a) : (e f g), on every product e f g of three rigid motions.
Eigen::VectorXd work_on_killing_tensors(const RigidMotions& motions, std::span<const double> x,
                                        std::span<const double> area_vector) {
  Vector3 area{};
  std::copy(area_vector.begin(), area_vector.end(), area.begin());
  const int count = motions.count();
  Eigen::VectorXd work(count * (count + 1) * (count + 2) / 6);
  Eigen::Index next = 0;
  for (int i = 0; i < count; ++i) {
    const Vector3 e = motions.at(i, x);
    for (int j = i; j < count; ++j) {
      const Vector3 f = motions.at(j, x);
      for (int k = j; k < count; ++k) {
        const Vector3 g = motions.at(k, x);
        work[next++] =
            dot(e, f) * dot(area, g) + dot(e, g) * dot(area, f) + dot(f, g) * dot(area, e);
      }
    }
  }
  return work;
}

/// One part of the body.
class Part {
 public:
  Part(Facets& facets, std::span<const double> positions, std::span<const double> modulus,
       std::vector<Index> members)
      : facets_(facets), positions_(positions), modulus_(modulus), members_(std::move(members)) {}

  void balance() {
    const RigidMotions motions = make_motions();
    Eigen::VectorXd defect, size;
    std::vector<Eigen::MatrixXd> gradients;  // per facet: of the work with the corners' shares
    Eigen::MatrixXd gram;
    for (const Index f : members_) {
      gradients.push_back(works(motions, f));
      Eigen::MatrixXd& work = gradients.back();
      if (gram.size() == 0) {
        gram = Eigen::MatrixXd::Zero(work.rows(), work.rows());
        defect = size = Eigen::VectorXd::Zero(work.rows());
      }
      const Index begin = facets_.corners.offsets[f];
      for (Eigen::Index c = 0; c < work.cols(); ++c) {
        defect += facets_.shares[begin + c] * work.col(c);
        size += facets_.shares[begin + c] * work.col(c).cwiseAbs();
      }
      // Shares of a facet change without changing their sum.
      work.colwise() -= work.rowwise().mean().eval();
      if (facets_.is_glued(f)) work.setZero();
      gram.noalias() += work * work.transpose();
    }
    if (defect.size() == 0 || defect.cwiseAbs().maxCoeff() <= balanced * size.maxCoeff()) return;
    // 6 of the 56 products in 3D repeat.
    const Eigen::VectorXd multiplier = gram.completeOrthogonalDecomposition().solve(-defect);
    for (std::size_t k = 0; k < members_.size(); ++k) {
      const Eigen::VectorXd change = gradients[k].transpose() * multiplier;
      const Index begin = facets_.corners.offsets[members_[k]];
      for (Eigen::Index c = 0; c < change.size(); ++c) facets_.shares[begin + c] += change[c];
    }
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

  /// Shape (Killing tensors, corners).
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
