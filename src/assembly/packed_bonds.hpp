#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <unordered_map>
#include <vector>

#include "base/block.hpp"
#include "network/network.hpp"

namespace perilink {

/// Trusses in single precision, sixteen bytes for each in space, by an order of the particles in
/// which neighbours are near each other: for searches whose residuals are computed from the network
/// itself. Each bond's force is that of the network to seven digits of the motions of its ends;
/// where these move far together few are left of it. Threads take one part of the order each; a
/// bond between two parts is there twice, for the force on either end.
class PackedBonds {
 public:
  /// \param place  where each particle comes in the order
  /// \param unit   stiffness that counts as one
  /// \param part_end  places up to which each part goes
  PackedBonds(const Network& network, Secants secants, std::span<const Index> place, double unit,
              std::span<const std::size_t> part_end);

  /// Takes over what has changed since: bonds that differ from then, one by one.
  void follow(Secants secants);

  /// Told of the places [begin, end) of a part whose forces are complete, one after the other;
  /// parts come at the same time.
  using PlacesDone = std::function<void(std::size_t part, std::size_t begin, std::size_t end)>;

  /// Forces without those of supports, over the unit.
  /// \param motions  by the order, shape (particles, dim, block_width), as `forces`
  void forces(std::span<const float> motions, std::span<float> forces,
              const PlacesDone& done) const;
  /// Numbers of a particle in one vector: in space there is a fourth, which is zero.
  static constexpr std::size_t row_size(int dim) { return dim == 2 ? 2 : 4; }
  /// The same of one motion, whose own digits are all there: shape (particles, row_size).
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

  /// n sqrt(k s) over the square root of the unit, and whose other end it is.
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
  /// Two rows of bonds for each place: to places behind it in its part, and to those of others.
  std::vector<std::size_t> begin_;
  std::vector<Packed<2>> plane_;
  std::vector<Packed<3>> space_;
  std::unordered_map<Index, double> damaged_;  ///< secants that are not one, as packed
};

}  // namespace perilink
