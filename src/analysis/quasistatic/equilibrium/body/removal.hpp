#pragma once

#include <array>
#include <span>
#include <vector>

#include "assembly/element_vector.hpp"
#include "base/sparse_vector.hpp"

namespace perilink {

/// An element that takes a smaller secant.
struct Weakening {
  Index element;
  double secant;  ///< 0: it breaks
};

/// Low-rank downdate of an element that breaks or weakens: K falls by the sum of x x' over its
/// vectors. A bar has one vector, a micropolar bond three or six.
struct Removal {
  static constexpr int capacity = ElementVectors::capacity;
  using Deformations = std::array<double, capacity>;
  int rank = 0;
  double fraction = 0.0;  ///< part of the intact stiffness that is removed
  std::array<SparseVector, capacity> x;
  std::array<double, capacity> prescribed{};  ///< contribution of prescribed motions to x'u
  std::array<double, capacity> constant{};    ///< x'u of the displacements by constant loads
  std::array<double, capacity> pivot{};       ///< 1 - x' K^-1 x, ascending; set by decouple()
  bool needs_new_inverse = false;             ///< the pivots are more accurate than K^-1 can follow
  bool on_supports = false;  ///< elastic supports hold most of what the removal frees

  std::span<const SparseVector> vectors() const {
    return {x.data(), static_cast<std::size_t>(rank)};
  }
  std::span<const double> load_changes() const {
    return {prescribed.data(), static_cast<std::size_t>(rank)};
  }
  std::span<const double> pivots() const { return {pivot.data(), static_cast<std::size_t>(rank)}; }

  /// Returns whether the removal acts on no unknown.
  bool acts_on_nothing() const { return rank == 1 && x[0].size() == 0; }

  /// Returns x'u at load factor 1, prescribed motions included. Its square is twice the energy of
  /// the vector.
  double deformation(int mode, std::span<const double> solution) const;
};

/// Sum of forces of elements on the unknowns.
class ForceOfElements {
 public:
  explicit ForceOfElements(std::size_t unknowns) : place_(unknowns, no_index) {}
  /// Adds x times a deformation by growing loads, and x times one by constant loads.
  void add(const SparseVector& x, double by_growing, double by_constant);
  SparseVector growing, constant;  ///< both have the same rows

 private:
  std::vector<Index> place_;  ///< per unknown: its position in both vectors, or no_index
};

/// Forces of different sizes along vectors of elements. They move the ends of elements apart in
/// every motion in which some ends move apart.
struct VariedForces {
  explicit VariedForces(std::size_t unknowns) : load(unknowns, 0.0) {}
  void add(const SparseVector& x);
  std::vector<double> load;  ///< per unknown
  double size = 0.5;         ///< of the force along the next vector
  double count = 0.0;        ///< number of vectors
};

/// Makes the removal of a part of an element's stiffness.
/// \param fraction  part of the intact stiffness that is removed
Removal make_removal(const Network& network, const Unknowns& unknowns, Index element,
                     double fraction);

/// Makes a removal with a separate part of the axial stiffness; both parts are positive.
Removal make_removal(const Network& network, const Unknowns& unknowns, Index element,
                     double fraction, double axial);

/// Makes the removal of a part of the axial stiffness only.
Removal make_axial_removal(const Network& network, const Unknowns& unknowns, Index element,
                           double fraction);

/// Combines the vectors so that they do not interact, x_a' K^-1 x_b = 0, and sets their pivots.
/// With C = x_a' K^-1 x_b and I - C = V diag(pivot) V', the new vectors are X V, and X X' stays.
/// The removal leaves K positive definite exactly if all pivots are positive. det(K - X X') /
/// det(K) is their product.
/// \param compliance  C, shape (rank, rank)
void decouple(Removal& removal, std::span<const double> compliance);

}  // namespace perilink
