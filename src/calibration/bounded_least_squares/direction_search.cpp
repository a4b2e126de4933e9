#include "calibration/bounded_least_squares/direction_search.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <utility>

namespace perilink {
namespace {

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

}  // namespace

bool descend(DirectionSearch& search, int most, const VectorMap& exact, const VectorMap& product,
             const VectorMap& precondition) {
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
