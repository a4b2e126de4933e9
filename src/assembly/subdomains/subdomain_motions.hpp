#pragma once

#include <array>
#include <span>
#include <vector>

#include "network/network.hpp"
#include "network/secants.hpp"
#include "network/unknowns.hpp"

namespace perilink {

/// Splits subdomains of particles where cracks cut them: parts without a connecting element become
/// subdomains.
/// \return the parts of the first subdomain first
std::vector<std::vector<Index>> split_by_cracks(const std::vector<std::vector<Index>>& subdomains,
                                                const Network& network, Secants secants);

/// Rigid-body coarse space P of the subdomains, for conjugate gradients on bodies too large for a
/// factor (docs/theory/large_bodies.md). Parts that cracks separate within a subdomain move
/// independently.
class SubdomainMotions {
 public:
  /// \param most  largest number of particles in a subdomain
  SubdomainMotions(const Network& network, Secants secants, const Unknowns& unknowns, Index most);

  Index num_subdomains() const { return static_cast<Index>(subdomains_.size()); }
  /// Number of motions per subdomain: three in the plane, six in space.
  int num_motions() const { return dim_ == 2 ? 3 : 6; }
  std::span<const Index> particles(Index subdomain) const { return subdomains_[subdomain]; }
  Index subdomain_of(Index particle) const { return subdomain_of_[particle]; }
  /// Returns the row of P of a particle's component, zero if the component is held.
  std::array<double, 6> row(Index particle, int component) const;

  /// Computes coarse = P' residual, shape (subdomains, motions).
  void restrict(std::span<const double> residual, std::span<double> coarse) const;
  /// Computes result += P coarse.
  void add(std::span<const double> coarse, std::span<double> result) const;

  /// Apply restrict() and add() to block_width vectors of all particles. Fine vectors have the
  /// shape (particles, width, block_width), zero where a component is held; coarse ones have the
  /// shape (block_width, subdomains, motions).
  void restrict_block(std::span<const double> residuals, std::span<double> coarse) const;
  void add_block(std::span<const double> coarse, std::span<double> results) const;

 private:
  template <class Visit>
  void for_each_move(Index particle, Visit visit) const;
  template <int Dim>
  void add_to_sums(Index particle, const double* force, double* sums) const;
  template <int Dim>
  void find_motion(Index particle, const double* values, double* motion) const;
  void find_centres(const Particles& particles);

  int dim_;
  const Unknowns& unknowns_;
  std::vector<std::vector<Index>> subdomains_;
  std::vector<Index> subdomain_of_;
  std::vector<double> arms_;  ///< from the subdomain's centre over its size, shape (particles, dim)
  std::vector<double> size_;  ///< scale of the rotations of each subdomain [length]
};

}  // namespace perilink
