#include "app/study/convergence.hpp"

#include <Eigen/Dense>
#include <cmath>
#include <limits>
#include <vector>

#include "base/dense/decompositions.hpp"

namespace perilink {
namespace {

/// Range of orders searched for a limit; outside it three values do not determine one.
constexpr double least_order = 0.1;
constexpr double largest_order = 10.0;

Eigen::Vector3d vector_at(std::span<const double> values, Index i, int dim) {
  Eigen::Vector3d result = Eigen::Vector3d::Zero();
  for (int axis = 0; axis < dim; ++axis) {
    result[axis] = values[static_cast<std::size_t>(i) * dim + axis];
  }
  return result;
}

}  // namespace

void remove_rigid_motion(const Particles& particles, std::span<double> field) {
  const int dim = particles.dim;
  const auto for_each_solid = [&](auto visit) {
    for (Index i = 0; i < particles.size(); ++i) {
      if (particles.kind[i] == ParticleKind::solid) visit(i, particles.volumes[i]);
    }
  };
  double volume = 0.0;
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();
  for_each_solid([&](Index i, double v) {
    volume += v;
    centre += v * vector_at(particles.positions, i, dim);
    translation += v * vector_at(field, i, dim);
  });
  centre /= volume;
  translation /= volume;
  // Normal equations of sum V |field - translation - omega x r|^2 -> min.
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();
  for_each_solid([&](Index i, double v) {
    const Eigen::Vector3d r = vector_at(particles.positions, i, dim) - centre;
    inertia += v * (r.squaredNorm() * Eigen::Matrix3d::Identity() - r * r.transpose());
    moment += v * r.cross(vector_at(field, i, dim));
  });
  // A plane body rotates only about the third axis, but its inertia tensor has the other two.
  if (dim == 2) moment.head<2>().setZero();
  const Eigen::Vector3d omega = least_squares<Eigen::VectorXd>(inertia, moment);
  for (Index i = 0; i < particles.size(); ++i) {
    const Eigen::Vector3d rigid =
        translation + omega.cross(vector_at(particles.positions, i, dim) - centre);
    for (int axis = 0; axis < dim; ++axis) {
      field[static_cast<std::size_t>(i) * dim + axis] -= rigid[axis];
    }
  }
}

double relative_l2_error(const Particles& particles, std::span<const double> displacement,
                         std::span<const double> exact, bool without_rigid_motion) {
  std::vector<double> difference(displacement.begin(), displacement.end());
  for (std::size_t k = 0; k < difference.size(); ++k) difference[k] -= exact[k];
  if (without_rigid_motion) remove_rigid_motion(particles, difference);
  double error = 0.0, size = 0.0;
  for (Index i = 0; i < particles.size(); ++i) {
    if (particles.kind[i] != ParticleKind::solid) continue;
    error += particles.volumes[i] * vector_at(difference, i, particles.dim).squaredNorm();
    size += particles.volumes[i] * vector_at(exact, i, particles.dim).squaredNorm();
  }
  return std::sqrt(error / size);
}

double observed_order(double coarse_spacing, double coarse_error, double fine_spacing,
                      double fine_error) {
  if (!(coarse_error > 0.0) || !(fine_error > 0.0) || coarse_spacing == fine_spacing) {
    return std::numeric_limits<double>::quiet_NaN();
  }
  return std::log(coarse_error / fine_error) / std::log(coarse_spacing / fine_spacing);
}

std::optional<Extrapolation> extrapolate(const std::array<double, 3>& spacings,
                                         const std::array<double, 3>& values) {
  const double far = values[0] - values[1];
  const double near = values[1] - values[2];
  if (!(far * near > 0.0)) return std::nullopt;
  // far / near = (h0^p - h1^p) / (h1^p - h2^p), which grows with p.
  const auto excess = [&](double p) {
    const double coarse = std::pow(spacings[0] / spacings[1], p);
    const double fine = std::pow(spacings[2] / spacings[1], p);
    return (coarse - 1.0) / (1.0 - fine) - far / near;
  };
  double low = least_order, high = largest_order;
  if (!(excess(low) <= 0.0) || !(excess(high) >= 0.0)) return std::nullopt;
  while (high - low > 1e-14 * high) {
    const double middle = 0.5 * (low + high);
    if (middle == low || middle == high) break;
    (excess(middle) < 0.0 ? low : high) = middle;
  }
  const double ratio = std::pow(spacings[1] / spacings[2], low);
  return Extrapolation{values[2] - near / (ratio - 1.0), low};
}

}  // namespace perilink
