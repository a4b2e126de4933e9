#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/types.hpp"
#include "network/network.hpp"

namespace perilink {

/// Motion of the particles: u = T q + prescribed, with the unknowns q. A component of a particle (a
/// "slot") is free with its own unknown, embedded, or prescribed. An embedded slot is a combination
/// of unknowns, such as the unknowns of a host element's nodes.
struct Unknowns {
  int width = 2;  ///< components of the motion of a particle, Network::width()
  Index count = 0;
  /// Number of the unknown of each slot, shape (particles, width). It is no_index for a prescribed
  /// slot and less for an embedded one, see carry().
  std::vector<Index> number;
  /// Displacement [length] or rotation [-] at load factor 1 of slots without unknowns, else 0;
  /// shape (particles, width).
  std::vector<double> prescribed;

  /// Coefficient of an unknown in an embedded slot.
  struct Share {
    Index unknown;
    double weight;
  };

  /// Makes a prescribed slot an embedded one, a weighted sum of unknowns.
  /// \param shares  at least one; an unknown appears at most once
  void carry(std::size_t slot, std::span<const Share> shares) {
    number[slot] = no_index - static_cast<Index>(rows_.size());
    shares_.insert(shares_.end(), shares.begin(), shares.end());
    rows_.push_back(shares_.size());
  }
  /// Adds an unknown without a slot of its own, a component of a node.
  /// \param node  common number of the node's unknowns, not the number of a particle
  Index add_shared(Index node) {
    nodes_.push_back(node);
    return count++;
  }
  /// Returns whether any slot is embedded.
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

  /// Returns T q + prescribed, the motion of all particles, shape (particles, width).
  std::vector<double> expand(std::span<const double> q) const;
  /// Computes T q + prescribed in some slots of the motion of all particles.
  void expand(std::span<const double> q, std::span<const std::size_t> slots,
              std::span<double> displacement) const;
  /// Returns T' f: forces on the unknowns from forces on particles, shape (particles, width).
  std::vector<double> restrict(std::span<const double> forces) const;
  /// Returns one slot per unknown: its own, or the first embedded slot that it moves. Size count.
  std::vector<std::size_t> slots() const;
  /// Returns the owner of each unknown, a particle or a node; unknowns of one owner are
  /// consecutive. Size count.
  std::vector<Index> owners() const;

  Index at(Index particle, int component) const {
    return number[static_cast<std::size_t>(particle) * width + component];
  }

 private:
  std::vector<std::size_t> rows_ = {0};  // begin of each embedded slot's shares, and an end
  std::vector<Share> shares_;
  std::vector<Index> nodes_;  // owners of the last unknowns
};

/// Checks the input of analyses without embedded particles.
/// \throws std::invalid_argument if a slot is embedded
void expect_nothing_embedded(const Unknowns& unknowns);

/// Numbers the unknowns in the order of the particles.
/// \param held  shape (particles, width): nonzero where the displacement or rotation is prescribed
Unknowns number_unknowns(int width, const std::vector<std::uint8_t>& held,
                         std::vector<double> prescribed);

/// Marks the embedded points as held, shape (particles, width): they have no unknowns of their own.
void hold_embedded_points(const Network& network, std::vector<std::uint8_t>& held);

/// Makes embedded points follow their particles, in addition to their prescribed motion.
void carry_embedded_points(const Network& network, Unknowns& unknowns);

/// Sets the motions of embedded points to the weighted sums over their particles,
/// shape (particles, width).
void follow_particles(const Network& network, std::span<double> motion);

/// Moves the forces of embedded points to their particles, with the weights of the motion.
void load_particles(const Network& network, std::span<double> forces);

/// Returns the largest displacement along an axis of a motion, shape (particles, width) [length].
double largest_displacement(const Network& network, std::span<const double> motion);

/// Whether a bond with bending stiffness turns each particle. Other particles have no rotations,
/// which must not be unknown. Empty where no bond carries a moment.
std::vector<std::uint8_t> rotating_particles(const Network& network);

/// Marks rotations without stiffness as held, shape (particles, width). In space this includes one
/// rotation of the first node of each straight bar that bends.
void hold_idle_rotations(const Network& network, std::vector<std::uint8_t>& held);

}  // namespace perilink
