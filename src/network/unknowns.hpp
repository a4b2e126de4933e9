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
    number[slot] = no_index - 1 - static_cast<Index>(rows_.size());
    rows_.emplace_back(shares.begin(), shares.end());
  }
  /// Whether any slot is carried.
  bool carries() const { return !rows_.empty(); }
  bool is_carried(std::size_t slot) const { return number[slot] < no_index; }

  /// Calls visit(unknown, weight) for the row of T of a slot.
  template <class Visit>
  void for_each(std::size_t slot, Visit visit) const {
    if (number[slot] >= 0) {
      visit(number[slot], 1.0);
    } else if (is_carried(slot)) {
      for (const Share& share : rows_[static_cast<std::size_t>(no_index - 1 - number[slot])]) {
        visit(share.unknown, share.weight);
      }
    }
  }

  /// T q + prescribed: the motion of all particles, shape (particles, width).
  std::vector<double> expand(std::span<const double> q) const;
  /// T' f: forces on particles, shape (particles, width), as forces on the unknowns.
  std::vector<double> restrict(std::span<const double> forces) const;
  /// A slot that each unknown moves: its own, or the first that it carries. Size count.
  std::vector<std::size_t> slots() const;

  Index at(Index particle, int component) const {
    return number[static_cast<std::size_t>(particle) * width + component];
  }

 private:
  std::vector<std::vector<Share>> rows_;  // per carried slot
};

/// For analyses that move every particle by itself.
/// \throws std::invalid_argument where something carries particles
void expect_nothing_carried(const Unknowns& unknowns);

/// Fills `number` and `count` in the order of the particles. `held` has shape (particles, width):
/// nonzero where the displacement or rotation is prescribed.
Unknowns number_unknowns(int width, const std::vector<std::uint8_t>& held,
                         std::vector<double> prescribed);

/// Particles that a bond with bending stiffness ends at; the rotations of the others mean nothing
/// and must not be unknown. Empty where no bond carries a moment.
std::vector<std::uint8_t> rotating_particles(const Network& network);

/// Marks the rotations of all particles that nothing turns as held, shape (particles, width).
void hold_idle_rotations(const Network& network, std::vector<std::uint8_t>& held);

}  // namespace perilink
