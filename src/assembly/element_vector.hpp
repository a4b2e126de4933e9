#pragma once

#include <array>

#include "base/sparse_vector.hpp"
#include "network/network.hpp"
#include "network/unknowns.hpp"

namespace perilink {

/// Returns the vector x of a truss's contribution x x' to the stiffness matrix, on the unknowns. It
/// is sqrt(k) n at the second end and -sqrt(k) n at the first. So x'u is sqrt(k) times the
/// extension, without the contribution of prescribed displacements.
/// \param stiffness  k, the element's stiffness or a part of it [force/length]
SparseVector element_vector(const Network& network, const Unknowns& unknowns, Index element,
                            double stiffness);

/// Contribution of an element to the stiffness matrix, the sum of x x' over `count` vectors x.
struct ElementVectors {
  static constexpr int capacity = 6;
  int count = 0;
  std::array<SparseVector, capacity> x;
  /// Contributions of prescribed motions to x'u at load factor 1: square roots of twice an energy.
  std::array<double, capacity> prescribed{};
};

/// Returns the vector of the axial mode.
/// \param fraction  part of the intact stiffness [-]
ElementVectors axial_vector(const Network& network, const Unknowns& unknowns, Index element,
                            double fraction);

/// Returns one vector per mode with stiffness, the axial one first. A truss has one; a micropolar
/// bond has three in two dimensions and six in three (network/frame.hpp).
/// \param fraction  part of the intact stiffness [-]
ElementVectors element_vectors(const Network& network, const Unknowns& unknowns, Index element,
                               double fraction);

}  // namespace perilink
