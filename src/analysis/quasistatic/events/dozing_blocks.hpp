#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "base/csr.hpp"
#include "discretization/hosts/hosts.hpp"
#include "network/network.hpp"
#include "network/unknowns.hpp"

namespace perilink {

/// Where a search finds what finite elements carry.
struct EmbeddedParticles {
  const Hosts& hosts;
  std::vector<Index> host;  ///< per particle, its element; no_index: it moves by itself
  const Unknowns& unknowns;
  const std::vector<double>& solution;  ///< q, as it is at each search
  std::vector<double>& displacement;  ///< by it, shape (particles, width); current where asked for
};

/// By how much the ratio of a bond to its limit can grow, per unit of displacement of the nodes and
/// per unit of their rotation, rigid motions of all of them left out.
struct Slope {
  double displacement = 0.0, rotation = 0.0;
};

/// Blocks of a search whose bonds have both ends in elements need no look at every event, and nor
/// need the displacements of their particles. The ratio R of a bond to its limit is a seminorm of
/// the motion: with what the nodes have moved since the last look, less any rigid motion,
///
///   R(q) <= R(q_0) + R(q - q_0),   R(q - q_0) <= slope times the largest motion of a node.
///
/// While that is below what another bond has come to, the block sleeps. Answers are those of a
/// search among all.
class DozingBlocks {
 public:
  /// Nothing dozes.
  DozingBlocks() = default;
  /// \param elements    those of the search, in its order
  /// \param block_size  so many are a block
  /// \param squares     bounds and what looks find are squares of ratios
  /// \param slope_of    slope for the bond at a place of the search, from the sum over the nodes of
  ///                    |N(second end) - N(first end)| and the largest sum of |N| at an end
  DozingBlocks(
      const Network& network, const EmbeddedParticles& embedded, std::span<const Index> elements,
      Index block_size, bool squares,
      const std::function<Slope(std::size_t place, double across, double at_end)>& slope_of);

  bool any() const { return !group_of_.empty(); }
  bool may_doze(Index block) const { return any() && group_of_[block] != no_index; }
  /// A block to look at first, so that others can be left out; no_index: any order will do.
  Index likeliest() const { return no_index; }
  /// Largest ratio that a bond of the block can have now.
  double bound(Index block);
  /// Makes the displacements of the block's particles current, for a look.
  void look(Index block);
  /// The same of all blocks that doze; what they remember stays, since it bounds them still.
  void look_everywhere();
  /// The largest seminorm that this look has found.
  void remember(Index block, double largest);
  /// The limit of the bond at a place has changed: its block is looked at always from now on.
  void wake(std::size_t place);

  /// Marks the particles that some block must have current at every event.
  /// \param elements  as the blocks were made of
  void mark_awake(const Network& network, std::span<const Index> elements,
                  std::vector<std::uint8_t>& awake) const;

 private:
  struct Group {
    std::size_t first_node, first_particle, last_particle;
    Index nodes;
    double inverse_inertia[9];
    Slope slope;
    double largest;  ///< ratio at the last look; infinity: none yet
    bool restless;
  };
  void add_group(const std::vector<Index>& nodes);
  void move_particles(const Group& group);

  const EmbeddedParticles* embedded_ = nullptr;
  int dim_ = 2, width_ = 2;
  Index block_size_ = 0;
  bool squares_ = false;
  std::vector<Index> group_of_;  ///< per block; no_index: always awake
  std::vector<Group> groups_;
  std::vector<Index> unknowns_;     ///< those that move the nodes, shape (nodes, width)
  std::vector<double> arms_;        ///< from their middle [length], shape (nodes, dim)
  std::vector<double> reference_;   ///< q_0, shape (nodes, width)
  std::vector<Index> particles_;    ///< group after group
  std::vector<double> moved_;       ///< work space, shape (nodes, width)
  std::vector<std::size_t> slots_;  ///< work space
};

}  // namespace perilink
