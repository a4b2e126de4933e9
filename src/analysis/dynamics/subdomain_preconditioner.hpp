#pragma once

#include <Eigen/Dense>
#include <array>
#include <span>
#include <utility>
#include <vector>

#include "network/network.hpp"
#include "network/unknowns.hpp"

namespace perilink {

/// What a particle adds to the deformation of a square of the energy, k (sum of b . q)^2 / 2.
struct EnergyPart {
  Index particle = 0;
  std::array<double, 6> b{};  ///< as many as its motion q has components
};

/// Approximates the inverse of the intact stiffness, prescribed components held, without
/// factorising it: the inverse of every particle's own block, plus the inverse for a body whose
/// boxes of particles move rigidly (a small dense matrix). Conjugate gradients then take as many
/// iterations as a box has particles across, however large the body is.
class SubdomainPreconditioner {
 public:
  /// \param unknowns  have to outlive this
  SubdomainPreconditioner(const Network& network, const Unknowns& unknowns);

  /// \param residual  and the result: shape (particles, width), zero at what is held
  Eigen::VectorXd times(const Eigen::VectorXd& residual) const;
  /// Largest own stiffness of a component over its mass [1/time^2].
  double fastest(const std::vector<double>& mass) const;

 private:
  using Motion = std::array<double, 6>;  ///< components of a particle or a box, as many as it has

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
  std::vector<double> arm_;     ///< from the middle of the box, over its side, (particles, dim)
  std::vector<double> blocks_;  ///< own stiffness, then its inverse, (particles, width, width)
  std::vector<double> diagonal_;
  Eigen::MatrixXd coarse_;
  Eigen::LDLT<Eigen::MatrixXd> inverse_;
  /// Boxes that one square of the energy involves.
  std::vector<std::pair<Index, Motion>> on_subdomains_;
};

}  // namespace perilink
