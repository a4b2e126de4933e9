#pragma once

#include <array>
#include <span>
#include <vector>

#include "assembly/element_vector.hpp"
#include "base/sparse_vector.hpp"

namespace perilink {

/// What an element takes with it when it breaks or weakens: K falls by the sum of x x' over its
/// modes, one of a bar and three or six of a micropolar bond.
struct Removal {
  static constexpr int capacity = ElementVectors::capacity;
  using Deformations = std::array<double, capacity>;
  int rank = 0;
  double fraction = 0.0;  ///< part of the intact stiffness that goes
  std::array<SparseVector, capacity> x;
  std::array<double, capacity> prescribed{};  ///< what prescribed motions add to x'u
  std::array<double, capacity> constant{};    ///< x'u of the displacements by constant loads
  std::array<double, capacity> pivot{};       ///< 1 - x' K^-1 x, ascending; set by decouple()

  std::span<const SparseVector> vectors() const {
    return {x.data(), static_cast<std::size_t>(rank)};
  }
  std::span<const double> load_changes() const {
    return {prescribed.data(), static_cast<std::size_t>(rank)};
  }
  std::span<const double> pivots() const { return {pivot.data(), static_cast<std::size_t>(rank)}; }

  /// x'u with what prescribed motions add, at load factor 1: its square is twice the energy of the
  /// mode.
  double deformation(int mode, std::span<const double> solution) const;
};

/// Forces on unknowns that elements take, or took.
class ForceOfElements {
 public:
  explicit ForceOfElements(std::size_t unknowns) : place_(unknowns, no_index) {}
  /// x times a deformation by the loads that grow and one by constant loads.
  void add(const SparseVector& x, double by_growing, double by_constant);
  SparseVector growing, constant;  ///< both have the same rows

 private:
  std::vector<Index> place_;  ///< per unknown: its place in them, or no_index
};

/// \param fraction  part of the intact stiffness that goes
Removal make_removal(const Network& network, const Unknowns& unknowns, Index element,
                     double fraction);

/// The same with a part of its own of the axial mode, positive, as the fraction is.
Removal make_removal(const Network& network, const Unknowns& unknowns, Index element,
                     double fraction, double axial);

/// The same of the axial mode alone.
Removal make_axial_removal(const Network& network, const Unknowns& unknowns, Index element,
                           double fraction);

/// Turns the modes into combinations that do not interact, x_a' K^-1 x_b = 0, and sets their
/// pivots: with C = x_a' K^-1 x_b and I - C = V diag(pivot) V', the new vectors are X V and X X'
/// stays. The removal leaves K positive definite exactly when all pivots are positive; det(K - X
/// X') / det(K) is their product.
/// \param compliance  C, shape (rank, rank)
void decouple(Removal& removal, std::span<const double> compliance);

}  // namespace perilink
