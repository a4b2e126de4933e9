#include "assembly/results/surface_fit.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/dense/decompositions.hpp"

namespace perilink {
namespace {

/// Smallest pivot of the normal equations over the largest, scaled to a neighbourhood of radius
/// one. Cubic polynomials have 1.5e-4 and more at the edges of square lattices with horizons of
/// two spacings, 2e-3 where the edge is free.
constexpr double smallest_fit_pivot = 1e-4;

/// Below it stresses may be singular, as at the corner of a notch: a right angle has -0.7.
constexpr double least_convexity = -0.65;

double power(double x, int exponent) {
  double result = 1.0;
  for (; exponent > 0; --exponent) result *= x;
  return result;
}

/// Monomials up to a degree, ascending: one, the coordinates, ...
template <int Dim>
class Monomials {
 public:
  using Exponents = std::array<int, Dim>;

  explicit Monomials(int degree) {
    for (int sum = 0; sum <= degree; ++sum) append({}, 0, sum);
  }

  Eigen::Index size() const { return static_cast<Eigen::Index>(exponents_.size()); }
  const Exponents& exponents(Eigen::Index term) const { return exponents_[term]; }
  /// Returns the number of a monomial.
  Eigen::Index find(const Exponents& exponents) const {
    return std::find(exponents_.begin(), exponents_.end(), exponents) - exponents_.begin();
  }
  /// Returns the values of all monomials at a point, or their derivatives along an axis.
  Eigen::RowVectorXd at(const double* x, int derivative = -1) const {
    Eigen::RowVectorXd values(size());
    for (Eigen::Index term = 0; term < size(); ++term) {
      Exponents e = exponents_[term];
      double value = 1.0;
      if (derivative >= 0) value = e[derivative]--;
      for (int a = 0; a < Dim; ++a) value *= power(x[a], e[a]);
      values[term] = value;
    }
    return values;
  }

 private:
  void append(Exponents exponents, int axis, int sum) {
    if (axis == Dim - 1) {
      exponents[axis] = sum;
      exponents_.push_back(exponents);
      return;
    }
    for (int e = sum; e >= 0; --e) {
      exponents[axis] = e;
      append(exponents, axis + 1, sum - e);
    }
  }

  std::vector<Exponents> exponents_;
};

/// Returns an orthonormal basis of the coefficients, shape (Dim * terms, unknowns), of
/// displacements in equilibrium, (lambda + mu) grad div u + mu div grad u = 0.
/// \param ratio  lambda / mu
template <int Dim>
Eigen::MatrixXd balanced_basis(const Monomials<Dim>& monomials, int degree, double ratio) {
  const Monomials<Dim> forces(degree - 2);
  const Eigen::Index terms = monomials.size();
  Eigen::MatrixXd equations = Eigen::MatrixXd::Zero(Dim * terms, Dim * forces.size());
  for (Eigen::Index term = 0; term < terms; ++term) {
    const auto add = [&](int equation, int component, int first, int second, double factor) {
      auto e = monomials.exponents(term);
      for (const int axis : {first, second}) factor *= e[axis]--;
      if (factor == 0.0) return;
      equations(component * terms + term, equation * forces.size() + forces.find(e)) += factor;
    };
    for (int a = 0; a < Dim; ++a) {
      for (int b = 0; b < Dim; ++b) {
        add(a, b, a, b, ratio + 1.0);
        add(a, a, b, b, 1.0);
      }
    }
  }
  return complement(equations);
}

/// Appends a row with the traction over mu along an axis.
template <int Dim>
Eigen::RowVectorXd traction_row(const Monomials<Dim>& monomials, const double* x,
                                const double* normal, int axis, double ratio) {
  const Eigen::Index terms = monomials.size();
  Eigen::RowVectorXd row = Eigen::RowVectorXd::Zero(Dim * terms);
  const Eigen::RowVectorXd along = monomials.at(x, axis);
  for (int c = 0; c < Dim; ++c) {
    const Eigen::RowVectorXd slope = monomials.at(x, c);
    row.segment(c * terms, terms) += ratio * normal[axis] * slope + normal[c] * along;
    row.segment(axis * terms, terms) += normal[c] * slope;
  }
  return row;
}

template <int Dim>
bool fit_balanced(std::span<const double> points, std::span<const double> marks, int degree,
                  double size, std::span<double> weights) {
  constexpr std::size_t stride = Dim + 2;
  const Monomials<Dim> monomials(degree);
  const Eigen::Index terms = monomials.size();
  const auto count = static_cast<Eigen::Index>(points.size() / Dim);
  const double ratio = marks[0];
  std::vector<Eigen::RowVectorXd> tractions;
  for (std::size_t m = 1; m < marks.size(); m += stride) {
    const double* x = points.data() + Dim * static_cast<std::size_t>(marks[m]);
    for (int a = 0; a < Dim; ++a) {
      if ((static_cast<int>(marks[m + 1]) >> a & 1) == 0) continue;
      tractions.push_back(traction_row(monomials, x, &marks[m + 2], a, ratio));
    }
  }
  const Eigen::MatrixXd basis = balanced_basis(monomials, degree, ratio);
  const Eigen::Index unknowns = basis.cols(), first_traction = Dim * count;
  Eigen::MatrixXd rows(first_traction + static_cast<Eigen::Index>(tractions.size()), unknowns);
  if (rows.rows() < unknowns) return false;
  Eigen::MatrixXd values(count, terms);
  for (Eigen::Index k = 0; k < count; ++k) values.row(k) = monomials.at(points.data() + Dim * k);
  for (int a = 0; a < Dim; ++a) {
    rows.middleRows(a * count, count) = values * basis.middleRows(a * terms, terms);
  }
  for (std::size_t k = 0; k < tractions.size(); ++k) {
    rows.row(first_traction + static_cast<Eigen::Index>(k)) = tractions[k] * basis;
  }
  Eigen::MatrixXd slopes(unknowns, Dim * Dim);  // of the unknowns in the gradient
  for (int a = 0; a < Dim; ++a) {
    for (int b = 0; b < Dim; ++b) {
      slopes.col(a * Dim + b) = basis.row(a * terms + 1 + b).transpose();
    }
  }
  if (!solve_symmetric(rows.transpose() * rows, slopes, smallest_fit_pivot)) return false;
  const Eigen::MatrixXd result = rows.topRows(first_traction) * slopes;
  double* weight = weights.data();
  for (Eigen::Index k = 1; k < count; ++k) {
    for (int c = 0; c < Dim; ++c) {
      for (int g = 0; g < Dim * Dim; ++g) *weight++ = result(c * count + k, g) / size;
    }
  }
  return true;
}

/// Returns the change of the normal along the way to another particle of the surface, positive
/// where the body is convex: the distance over the radius of curvature, 0.7 at the end of a right
/// angle.
double convexity(const Particles& particles, const SurfaceConditions& surface, Index from,
                 Index to) {
  double change = 0.0, square = 0.0;
  for (int a = 0; a < particles.dim; ++a) {
    const double way = particles.position(to)[a] - particles.position(from)[a];
    change += way * (surface.normal(to)[a] - surface.normal(from)[a]);
    square += way * way;
  }
  return change / std::sqrt(square);
}

/// Returns whether all bonds of a particle are intact. Contact springs do not count.
bool is_intact(const StressInput& input, Index particle) {
  if (input.secants.size() == 0) return true;
  return std::ranges::all_of(input.neighbourhoods.row(particle), [&](Index e) {
    return input.network.is_contact(e) || !(input.secants.least(e) < 1.0);
  });
}

}  // namespace

bool collect_surface_marks(const StressInput& input, Index particle,
                           std::span<const Index> neighbors, std::vector<double>& marks) {
  const SurfaceConditions* surface = input.surface;
  if (surface == nullptr || surface->normal(particle).empty()) return false;
  const HookeConstants& constants = input.materials[input.network.particles.material[particle]];
  const int every_axis = (1 << input.network.dim()) - 1;
  const Particles& particles = input.network.particles;
  bool held = false, free = false;
  marks.assign(1, constants.lambda / constants.mu);
  for (std::size_t k = 0; k <= neighbors.size(); ++k) {
    const Index i = k == 0 ? particle : neighbors[k - 1];
    if (!is_intact(input, i)) return false;
    const std::span<const double> normal = surface->normal(i);
    const int unloaded = surface->unloaded[i];
    if (normal.empty() && unloaded != every_axis) return false;
    if (normal.empty()) continue;
    if (k > 0 && convexity(particles, *surface, particle, i) < least_convexity) return false;
    (unloaded == 0 ? held : free) = true;
    if (held && free) return false;
    if (unloaded == 0) continue;
    marks.push_back(static_cast<double>(k));
    marks.push_back(unloaded);
    marks.insert(marks.end(), normal.begin(), normal.end());
  }
  return true;
}

template <int Dim>
bool fit_surface_gradient(std::span<const double> offsets, std::span<const double> marks,
                          std::span<double> weights) {
  std::vector<double> points(Dim, 0.0);
  points.insert(points.end(), offsets.begin(), offsets.end());
  double square = 0.0;
  for (std::size_t k = 0; k < points.size(); k += Dim) {
    square =
        std::max(square, Eigen::Map<const Eigen::Vector<double, Dim>>(&points[k]).squaredNorm());
  }
  const double size = std::sqrt(square);
  for (double& x : points) x /= size;
  return fit_balanced<Dim>(points, marks, 3, size, weights) ||
         fit_balanced<Dim>(points, marks, 2, size, weights);
}

template bool fit_surface_gradient<2>(std::span<const double>, std::span<const double>,
                                      std::span<double>);
template bool fit_surface_gradient<3>(std::span<const double>, std::span<const double>,
                                      std::span<double>);

}  // namespace perilink
