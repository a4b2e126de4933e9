#pragma once

#include <array>

#include "base/sparse_vector.hpp"
#include "network/network.hpp"
#include "network/unknowns.hpp"

namespace perilink {

/// The x of a truss's part x x' of the stiffness matrix: sqrt(k) n at its second end and -sqrt(k) n
/// at its first, on the unknowns; so x'u is sqrt(k) times the extension, but for what prescribed
/// displacements add.
/// \param stiffness  k, the stiffness or the part of it that is meant [force/length]
SparseVector element_vector(const Network& network, const Unknowns& unknowns, Index element,
                            double stiffness);

/// The part of an element in the stiffness matrix as a sum of x x'.
struct ElementVectors {
  static constexpr int capacity = 6;
  int count = 0;
  std::array<SparseVector, capacity> x;
  /// What prescribed motions add to x'u at load factor 1: square roots of twice an energy.
  std::array<double, capacity> prescribed{};
};

/// That of the axial mode alone.
ElementVectors axial_vector(const Network& network, const Unknowns& unknowns, Index element,
                            double fraction);

/// One vector per mode that has stiffness: one of a truss; three of a micropolar bond in two
/// dimensions and six in three (network/frame.hpp), the axial one first.
/// \param fraction  part of the intact stiffness that is meant
ElementVectors element_vectors(const Network& network, const Unknowns& unknowns, Index element,
                               double fraction);

}  // namespace perilink
