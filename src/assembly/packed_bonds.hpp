#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <unordered_map>
#include <vector>

#include "base/block.hpp"
#include "network/network.hpp"

namespace perilink {

/// Truss bonds in single precision, 16 bytes each in space, in a particle order that keeps
/// neighbours close. They serve iterative solves whose residuals come from the network itself. A
/// bond force has seven digits relative to the motions of its ends, and few where both ends move
/// far together. Each thread takes one part of the order. A bond between two parts is stored twice,
/// once for the force on each end.
class PackedBonds {
 public:
  /// \param place     position of each particle in the order
  /// \param unit      stiffness that scales all others [force/length]
  /// \param part_end  end of each part in the order
  PackedBonds(const Network& network, Secants secants, std::span<const Index> place, double unit,
              std::span<const std::size_t> part_end);

  /// Updates the bonds whose secants have changed.
  void follow(Secants secants);

  /// Callback for places [begin, end) of a part with complete forces. Calls for one part are in
  /// order; calls for different parts are concurrent.
  using PlacesDone = std::function<void(std::size_t part, std::size_t begin, std::size_t end)>;

  /// Computes the forces without supports, over the unit.
  /// \param motions  in the order, shape (particles, dim, block_width), as `forces`
  void forces(std::span<const float> motions, std::span<float> forces,
              const PlacesDone& done) const;
  /// Numbers per particle in one vector: in space a zero is the fourth.
  static constexpr std::size_t row_size(int dim) { return dim == 2 ? 2 : 4; }
  /// Computes the forces of one motion in double precision; shape (particles, row_size).
  void forces(std::span<const double> motion, std::span<double> forces) const;

  Index place(Index particle) const { return place_[particle]; }
  double unit() const { return unit_; }

 private:
  template <int Dim>
  void fill(Secants secants);
  template <int Dim>
  void set(Index element, double before, double now);
  void set_any(Index element, double before, double now);
  template <template <int> class Row, class Number, class Done>
  void all_forces(const Number* motions, Number* forces, const Done& done) const;
  template <int Dim, class Row>
  void region_forces(std::size_t place, const typename Row::Number* motions,
                     typename Row::Number* forces) const;
  template <int Dim, class Row, class Done>
  void part_forces(std::size_t part, const typename Row::Number* motions,
                   typename Row::Number* forces, const Done& done) const;

  /// n sqrt(k s) over the square root of the unit, and the place of the other end.
  template <int Dim>
  struct Packed {
    float pull[Dim];
    std::int32_t other;
  };
  template <int Dim>
  Packed<Dim> packed(Index element, double secant) const;
  template <class Visit>
  void for_each_row(Index element, Visit visit) const;
  template <int Dim>
  auto& bonds();
  template <int Dim>
  const auto& bonds() const;

  const Network& network_;
  std::vector<Index> place_;
  double unit_;
  std::vector<std::size_t> part_end_;
  /// Two rows of bonds per place: to later places in its part, and to places of other parts.
  std::vector<std::size_t> begin_;
  std::vector<Packed<2>> plane_;
  std::vector<Packed<3>> space_;
  std::unordered_map<Index, double> damaged_;  ///< secants other than one, as packed
};

}  // namespace perilink
