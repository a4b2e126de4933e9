#pragma once

#include <span>
#include <vector>

#include "assembly/packed_bonds.hpp"
#include "assembly/subdomains/subdomain_motions.hpp"
#include "base/block.hpp"
#include "network/network.hpp"
#include "network/unknowns.hpp"
#include "solver/blocks/block_gradients.hpp"
#include "solver/factor.hpp"

namespace perilink {

/// Order of particles by subdomain, so that neighbours are close in memory.
struct SubdomainOrder {
  SubdomainOrder(const SubdomainMotions& motions, Index particles);

  std::vector<Index> place;  ///< position of each particle in the order
  /// End position of each subdomain; the first entry is zero.
  std::vector<std::size_t> subdomain_end;
  /// End subdomain of each part; the first entry is zero. Parts hold about equal numbers of
  /// particles and do not depend on the number of threads.
  std::vector<std::size_t> part_subdomain;
  std::vector<std::size_t> part_end() const;  ///< end position of each part
};

/// Truss body in single precision, for iterations whose residuals are computed elsewhere. Provides
/// product and preconditioner (docs/theory/large_bodies.md, L-1) for block_width vectors at once.
/// Vectors have shape (particles, dim, block_width). Forces are in units of the root of a
/// stiffness, motions in units of its inverse, so that energies are unscaled.
class SingleBody {
 public:
  /// Returns whether a body consists of trusses only.
  static bool is_made_of(const Network& network);

  /// \param blocks  inverse stiffness of each particle, shape (particles, dim, dim)
  /// \param coarse  factor of P'K P
  /// \param order, bonds, unknowns  kept by reference, as is the network
  SingleBody(const Network& network, const Unknowns& unknowns, const SubdomainMotions& motions,
             const SubdomainOrder& order, PackedBonds& bonds, std::span<const double> blocks,
             const Factor& coarse);

  /// Adopts changed secants and ground springs.
  /// \param ground  stiffness of ground springs per unknown, or empty
  void follow(Secants secants, std::span<const double> ground);

  /// Computes forces = K motions. At held unknowns, forces are reactions and motions are zero.
  void multiply(std::span<const float> motions, std::span<float> forces,
                const RowsDone& done) const;
  void precondition(std::span<const float> residuals, std::span<float> motions,
                    const RowsDone& done);

 private:
  template <int Dim>
  void restrict_to_subdomains(std::size_t part, const float* residuals);
  template <int Dim>
  void add_motions(std::size_t part, const float* residuals, float* motions,
                   const RowsDone& done) const;
  template <class Work>
  void for_each_part(Work work) const;

  const Network& network_;
  const Unknowns& unknowns_;
  const SubdomainOrder& order_;
  PackedBonds& bonds_;
  std::vector<float> springs_;  ///< stiffness to the ground, in the order; empty: none
  std::vector<float> blocks_;   ///< inverse stiffness of particles, in the order, zero where held
  std::vector<float> moves_;    ///< rows of P, in the order, shape (particles, dim, motions)
  SingleFactor factor_;         ///< factor of P'K P over the unit of stiffness
  BlockVector<float> coarse_;   ///< shape (subdomains, motions, block_width), in the factor's order
};

}  // namespace perilink
