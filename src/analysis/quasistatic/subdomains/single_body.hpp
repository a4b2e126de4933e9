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

/// Particles box after box, so that what is near is near in memory.
struct SubdomainOrder {
  SubdomainOrder(const SubdomainMotions& motions, Index particles);

  std::vector<Index> place;  ///< where each particle comes
  /// Places up to which the particles of each box go; zero before the first.
  std::vector<std::size_t> subdomain_end;
  /// Boxes up to which parts of about as many particles each go, however many threads there are;
  /// zero before the first.
  std::vector<std::size_t> part_subdomain;
  std::vector<std::size_t> part_end() const;  ///< places up to which each part goes
};

/// A body of trusses in single precision, for the steps of a search whose residuals are computed
/// elsewhere: product and preconditioner (docs/theory/large_bodies.md, L-1) of block_width vectors
/// side by side. Vectors have shape (particles, dim, block_width); forces count by the root of a
/// stiffness, and motions by one over it, so that energies are what they are.
class SingleBody {
 public:
  /// Whether a body consists of nothing but trusses.
  static bool is_made_of(const Network& network);

  /// \param blocks  inverse ones of the particles, shape (particles, dim, dim)
  /// \param coarse  factor of P'K P
  /// \param order, bonds, unknowns  kept by reference, as the network
  SingleBody(const Network& network, const Unknowns& unknowns, const SubdomainMotions& motions,
             const SubdomainOrder& order, PackedBonds& bonds, std::span<const double> blocks,
             const Factor& coarse);

  /// Takes over what has changed since.
  /// \param ground  springs that hold unknowns, or empty
  void follow(Secants secants, std::span<const double> ground);

  /// forces = K motions; where something is held they are those that hold it, and motions zero.
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
  std::vector<float> springs_;  ///< to the ground, by the order; empty: none
  std::vector<float> blocks_;   ///< inverse ones, by the order, zero where something is held
  std::vector<float> moves_;    ///< rows of P, by the order, shape (particles, dim, motions)
  SingleFactor factor_;         ///< that P'K P over the unit has
  BlockVector<float> coarse_;   ///< shape (boxes, motions, block_width), by its order
};

}  // namespace perilink
