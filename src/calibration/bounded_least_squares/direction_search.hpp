#pragma once

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include <Eigen/Core>

namespace perilink {

/// Least size of vectors that threads share, and the number of their parts.
constexpr std::size_t long_vector = 80000, parts_of_vectors = 8;

/// Calls visit(part, begin, end), at the same time for the parts of long vectors.
template <class Visit>
void for_each_part_of(std::size_t size, Visit visit) {
  const std::size_t parts = size > long_vector ? parts_of_vectors : 1;
#pragma omp parallel for schedule(static) if (parts > 1)
  for (std::size_t part = 0; part < parts; ++part) {
    visit(part, part * size / parts, (part + 1) * size / parts);
  }
}

/// Returns a'b, with one order of sums for any number of threads.
inline double dot(const std::vector<double>& a, const std::vector<double>& b) {
  // A single sum would take four cycles per number, because each addition depends on the last.
  constexpr std::size_t lanes = 8;
  double sums[parts_of_vectors] = {};
  for_each_part_of(a.size(), [&](std::size_t part, std::size_t k, std::size_t end) {
    double lane[lanes] = {};
    for (; a.size() > long_vector && k + lanes <= end; k += lanes) {
      for (std::size_t l = 0; l < lanes; ++l) lane[l] += a[k + l] * b[k + l];
    }
    double sum = 0.0;
    for (const double own : lane) sum += own;
    for (; k < end; ++k) sum += a[k] * b[k];
    sums[part] = sum;
  });
  double sum = 0.0;
  for (const double own : sums) sum += own;
  return sum;
}

/// a = b + factor * c
inline void combine(std::vector<double>& a, const std::vector<double>& b, double factor,
                    const std::vector<double>& c) {
  for_each_part_of(a.size(), [&](std::size_t, std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) a[k] = b[k] + factor * c[k];
  });
}

inline double norm(const std::vector<double>& a) { return std::sqrt(dot(a, a)); }

/// Round-off of the residual over the norm of the multipliers (a tenth of an ulp, measured on
/// strips of up to 60 000 particles). Multipliers of long waves along thin bodies reach 1e9.
/// Iterations below this limit only change round-off.
constexpr double round_off = 2e-17;

/// State of a solution by conjugate gradients.
struct DirectionSearch {
  const std::vector<double>& right;
  double target;  ///< required norm of the residual
  std::vector<double> residual, direction;
  int iterations = 0;
  int cheap_iterations = 0;  ///< iterations that may continue below the target
  bool rounded = false;      ///< whether products of the steps have single precision
  /// Whether directions are made conjugate to all former directions (FormerDirections).
  bool keeps_directions = false;

  static constexpr double cheap_reduction = 0.1;
  /// Products of single precision are used until residuals have fallen by the first factor, and
  /// abandoned where the fall is less than the second.
  static constexpr double digits_of_steps = 1e-4, least_gain = 0.1;
};

/// Directions of a solution with their products. In exact arithmetic a new direction is conjugate
/// to all former directions. Round-off destroys this after some tens of iterations and grows:
/// coarse solutions would depend on the last bit of the equations.
class FormerDirections {
 public:
  void add(const std::vector<double>& direction, const std::vector<double>& product,
           double curvature) {
    if ((directions_.size() + 1) * direction.size() > most_numbers) return;
    directions_.push_back(map(direction));
    products_.push_back(map(product) / curvature);
  }
  void make_conjugate(std::vector<double>& direction) const {
    Eigen::Map<Eigen::VectorXd> result(direction.data(), map(direction).size());
    for (std::size_t k = directions_.size(); k-- > 0;) {
      result -= products_[k].dot(result) * directions_[k];
    }
  }

 private:
  /// 128 MB; larger bodies have less growth of round-off.
  static constexpr std::size_t most_numbers = 8'000'000;
  static Eigen::Map<const Eigen::VectorXd> map(const std::vector<double>& vector) {
    return {vector.data(), static_cast<Eigen::Index>(vector.size())};
  }
  std::vector<Eigen::VectorXd> directions_, products_;  // products over curvatures
};

/// Iterates at most `most` times. Steps with products of single precision compute the exact
/// residual whenever it seems to have fallen by digits_of_steps, and make the next direction
/// conjugate to the last. Where the exact residual has hardly fallen, the iteration continues with
/// exact products.
/// \param exact, product  products with the matrix, called as exact(vector, result)
/// \return whether the target is reached
template <class Exact, class Product, class Precondition>
bool descend(DirectionSearch& search, int most, Exact exact, Product product,
             Precondition precondition) {
  std::vector<double>& r = search.residual;
  std::vector<double> z(r.size()), q(r.size());
  const auto find_residual = [&] {
    exact(search.direction, r);
    combine(r, search.right, -1.0, r);
  };
  if (search.iterations > 0) find_residual();
  precondition(r, z);
  std::vector<double> p = z;
  double rz = dot(r, z), rp = rz, curvature = 0.0, exact_size = norm(r);
  const bool corrects =
      search.rounded && search.target < search.digits_of_steps * norm(search.right);
  bool is_exact = true;
  FormerDirections former;
  for (int count = 0;;) {
    const bool cheap = count < search.cheap_iterations;
    const double enough = cheap ? search.cheap_reduction * search.target : search.target;
    const double left = norm(r);
    const bool reached = left <= std::max(enough, round_off * norm(search.direction));
    if (reached && is_exact) return true;
    if (count == most) return false;
    if (!is_exact && (reached || left < search.digits_of_steps * exact_size)) {
      find_residual();
      const double before = std::exchange(exact_size, norm(r));
      search.rounded = exact_size <= search.least_gain * before;
      is_exact = true;
      precondition(r, z);
      rz = dot(r, z);
      const double share = dot(q, z) / curvature;
      combine(p, z, -share, p);
      rp = dot(p, r);
      continue;
    }
    product(p, q);
    curvature = dot(p, q);
    const double step = rp / curvature;
    combine(search.direction, search.direction, step, p);
    combine(r, r, -step, q);
    is_exact = !corrects || !search.rounded;
    precondition(r, z);
    const double next = dot(r, z);
    if (search.keeps_directions) former.add(p, q, curvature);
    combine(p, z, next / rz, p);
    if (search.keeps_directions) former.make_conjugate(p);
    rp = rz = next;
    ++count;
    ++search.iterations;
  }
}

}  // namespace perilink
