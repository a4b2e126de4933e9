#pragma once

#include <Eigen/Dense>
#include <array>
#include <span>
#include <utility>
#include <vector>

#include "network/network.hpp"
#include "network/unknowns.hpp"

namespace perilink {

/// Contribution of a particle to the deformation in a square of the energy, k (sum of b . q)^2 / 2.
struct EnergyPart {
  Index particle = 0;
  std::array<double, 6> b{};  ///< one per component of the motion q
};

/// Approximate inverse of the intact stiffness with prescribed components fixed, without a factor
/// of the stiffness. It is the sum of the inverse of every particle's own block and a coarse
/// inverse. The coarse matrix, small and dense, belongs to rigid motions of subdomains. The number
/// of conjugate-gradient iterations grows with the particles along an edge of a subdomain, not with
/// the size of the body.
class SubdomainPreconditioner {
 public:
  /// \param unknowns  must outlive this object
  SubdomainPreconditioner(const Network& network, const Unknowns& unknowns);

  /// Applies the approximate inverse.
  /// \param residual  shape (particles, width), like the result; zero at prescribed components
  Eigen::VectorXd times(const Eigen::VectorXd& residual) const;
  /// Returns the largest own stiffness of a component over its mass [1/time^2].
  double fastest(const std::vector<double>& mass) const;

 private:
  using Motion = std::array<double, 6>;  ///< components of the motion of a particle or a subdomain

  void number_subdomains(const Particles& particles);
  void set_arms(const Particles& particles);
  void add(double stiffness, std::span<const EnergyPart> parts);
  void invert_blocks();
  Motion on_subdomain(Index particle, const double* b) const;
  Motion of_subdomain(Index particle, const double* subdomain) const;

  int dim_, width_, modes_;
  const std::vector<Index>& number_;
  Index subdomains_ = 0;
  double side_ = 1.0;
  std::vector<Index> subdomain_of_;
  /// from the centre of the subdomain, over its edge length, (particles, dim)
  std::vector<double> arm_;
  std::vector<double> blocks_;  ///< own stiffness, then its inverse, (particles, width, width)
  std::vector<double> diagonal_;
  Eigen::MatrixXd coarse_;
  Eigen::LDLT<Eigen::MatrixXd> inverse_;
  /// Subdomains in one square of the energy.
  std::vector<std::pair<Index, Motion>> on_subdomains_;
};

}  // namespace perilink
