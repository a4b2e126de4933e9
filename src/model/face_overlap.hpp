#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>

#include "model/model.hpp"

/// \file
/// Faces of pre-cracks that pass through each other, since nothing was said about their closing.

namespace perilink {

/// Overlap of the faces of a pre-crack.
struct FaceOverlap {
  double depth = 0.0;     ///< [length]; 0: none
  Vector3 place{};        ///< of the deepest overlap
  std::size_t entry = 0;  ///< in [[cracks]]

  template <class Archive>
  void serialize(Archive& archive) {
    archive(depth, place, entry);
  }
};

/// Returns the deepest overlap among the pre-cracks without `closing`, or the deepest so far. It is
/// measured between particles up to 1.5 spacings apart, and counts where it is three times the
/// largest shortening of bonds up to this length: such particles approach each other in sound
/// material too. Neither a rotation of the body nor a slip of the faces counts. Shells, and bodies
/// with contact springs across pre-cracks, are left out.
/// \param motion  displacements, shape (particles, width) [length]
FaceOverlap deepest_overlap(const Model& model, std::span<const double> motion,
                            const FaceOverlap& so_far = {});

/// Returns a warning about an overlap.
std::optional<std::string> warning_about_overlap(const FaceOverlap& overlap, int dim);

}  // namespace perilink
