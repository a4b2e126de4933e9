#pragma once

#include <array>
#include <span>
#include <vector>

#include "network/network.hpp"
#include "network/secants.hpp"
#include "network/unknowns.hpp"

namespace perilink {

/// Splits boxes of particles: parts of one that no element inside joins become boxes of their own.
/// \return those of the first box first
std::vector<std::vector<Index>> split_by_cracks(const std::vector<std::vector<Index>>& subdomains,
                                                const Network& network, Secants secants);

/// Rigid motions of boxes of neighbouring particles, as fields P of the unknowns: the coarse space
/// of conjugate gradients for bodies too large for a factor (docs/theory/large_bodies.md). What
/// cracks have cut apart inside a box moves by itself.
class SubdomainMotions {
 public:
  /// \param most  particles of a box, at most
  SubdomainMotions(const Network& network, Secants secants, const Unknowns& unknowns, Index most);

  Index num_subdomains() const { return static_cast<Index>(subdomains_.size()); }
  /// Motions of a box: three in the plane, six in space.
  int num_motions() const { return dim_ == 2 ? 3 : 6; }
  std::span<const Index> particles(Index subdomain) const { return subdomains_[subdomain]; }
  Index subdomain_of(Index particle) const { return subdomain_of_[particle]; }
  /// Row of P of a component of a particle: how it moves with the motions of its box; zero where it
  /// is held.
  std::array<double, 6> row(Index particle, int component) const;

  /// coarse = P' residual, shape (boxes, motions)
  void restrict(std::span<const double> residual, std::span<double> coarse) const;
  /// result += P coarse
  void add(std::span<const double> coarse, std::span<double> result) const;

  /// The same of many vectors side by side, of all particles: those of shape (particles, width,
  /// block_width), zero where something is held, and coarse ones of shape (block_width, boxes,
  /// motions).
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
  std::vector<double> arms_;  ///< from the centre of the box over its size, shape (particles, dim)
  std::vector<double> size_;  ///< by which rotations of each box are scaled [length]
};

}  // namespace perilink
