#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/types.hpp"
#include "network/network.hpp"

namespace perilink {

/// How particles move: u = T q + prescribed, q the unknowns. A component of a particle (a "slot")
/// is free (its own unknown), carried (a combination of unknowns, such as those of an element's
/// nodes) or prescribed.
struct Unknowns {
  int width = 2;  ///< components of the motion of a particle, Network::width()
  Index count = 0;
  /// Shape (particles, width): number of the unknown of a free slot, no_index of a prescribed one,
  /// below that of a carried one, see carry().
  std::vector<Index> number;
  /// Shape (particles, width): displacement [length] or rotation [-] at load factor 1 where no
  /// unknown moves the slot, else 0.
  std::vector<double> prescribed;

  /// What an unknown adds to a carried slot, per unit.
  struct Share {
    Index unknown;
    double weight;
  };

  /// Lets a combination of unknowns move a slot that was prescribed; at least one, each once.
  void carry(std::size_t slot, std::span<const Share> shares) {
    number[slot] = no_index - static_cast<Index>(rows_.size());
    shares_.insert(shares_.end(), shares.begin(), shares.end());
    rows_.push_back(shares_.size());
  }
  /// One unknown more, that moves no slot by itself: a component of a node.
  /// \param node  number that the unknowns of the node have in common and no particle has
  Index add_shared(Index node) {
    nodes_.push_back(node);
    return count++;
  }
  /// Whether any slot is carried.
  bool carries() const { return rows_.size() > 1; }
  bool is_embedded(std::size_t slot) const { return number[slot] < no_index; }

  /// Calls visit(unknown, weight) for the row of T of a slot.
  template <class Visit>
  void for_each(std::size_t slot, Visit visit) const {
    if (number[slot] >= 0) {
      visit(number[slot], 1.0);
    } else if (is_embedded(slot)) {
      const auto row = static_cast<std::size_t>(no_index - 1 - number[slot]);
      for (std::size_t k = rows_[row]; k < rows_[row + 1]; ++k) {
        visit(shares_[k].unknown, shares_[k].weight);
      }
    }
  }

  /// T q + prescribed: the motion of all particles, shape (particles, width).
  std::vector<double> expand(std::span<const double> q) const;
  /// The same of some slots alone, into the motion of all particles.
  void expand(std::span<const double> q, std::span<const std::size_t> slots,
              std::span<double> displacement) const;
  /// T' f: forces on particles, shape (particles, width), as forces on the unknowns.
  std::vector<double> restrict(std::span<const double> forces) const;
  /// A slot that each unknown moves: its own, or the first that it carries. Size count.
  std::vector<std::size_t> slots() const;
  /// Whose each unknown is, a particle's or a node's; those of one lie side by side. Size count.
  std::vector<Index> owners() const;

  Index at(Index particle, int component) const {
    return number[static_cast<std::size_t>(particle) * width + component];
  }

 private:
  std::vector<std::size_t> rows_ = {0};  // where the shares of each carried slot begin, and an end
  std::vector<Share> shares_;
  std::vector<Index> nodes_;  // whose the last unknowns are
};

/// For analyses that move every particle by itself.
/// \throws std::invalid_argument where something carries particles
void expect_nothing_embedded(const Unknowns& unknowns);

/// Fills `number` and `count` in the order of the particles. `held` has shape (particles, width):
/// nonzero where the displacement or rotation is prescribed.
Unknowns number_unknowns(int width, const std::vector<std::uint8_t>& held,
                         std::vector<double> prescribed);

/// Marks the anchors as held, shape (particles, width): they have no unknowns of their own.
void hold_embedded_points(const Network& network, std::vector<std::uint8_t>& held);

/// Lets anchors move with their particles, beside what is prescribed for them.
void carry_embedded_points(const Network& network, Unknowns& unknowns);

/// Sums over the particles of anchors with their weights, in place of the motions of anchors, shape
/// (particles, width).
void follow_particles(const Network& network, std::span<double> motion);

/// The other way round: adds the forces of anchors to those of their particles, and takes them from
/// the anchors.
void load_particles(const Network& network, std::span<double> forces);

/// Whether a bond with bending stiffness turns each particle. Other particles have no rotations,
/// which must not be unknown. Empty where no bond carries a moment.
std::vector<std::uint8_t> rotating_particles(const Network& network);

/// Marks the rotations of all particles that nothing turns as held, shape (particles, width). In
/// space also one of the first node of each straight bar that bends: it turns freely about itself.
void hold_idle_rotations(const Network& network, std::vector<std::uint8_t>& held);

}  // namespace perilink
