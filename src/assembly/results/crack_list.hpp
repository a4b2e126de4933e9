#pragma once

#include <optional>
#include <span>
#include <vector>

#include "assembly/results/crack_state.hpp"
#include "base/csr.hpp"
#include "network/network.hpp"

namespace perilink {

/// A crack of a damaged body: place, direction, size and openings.
struct GrownCrack {
  Index bonds = 0;                     ///< damaged bonds
  std::vector<double> middle;          ///< mean of their middles, weighted with openings, size dim
  std::vector<double> normal;          ///< unit normal of the fitted line or plane, size dim [-]
  double length = 0.0;                 ///< extent along the main axis of the fit [length]
  double mean_opening = 0.0;           ///< of the damaged bonds [length]
  double largest_opening = 0.0;        ///< of its cells [length]
  std::vector<double> widest_at;       ///< where it is widest, size dim [length]
  std::optional<double> face_opening;  ///< largest at a surface or pre-crack [length]
  std::optional<Index> bar;            ///< number of the bar at which the crack is widest
  double bar_opening = 0.0;            ///< at that bar [length]

  template <class Archive>
  void serialize(Archive& archive) {
    archive(bonds, middle, normal, length, mean_opening, largest_opening, widest_at, face_opening,
            bar, bar_opening);
  }
};

/// Returns the cracks of a body one by one, the widest first. Damaged bonds are collected in cells
/// of one spacing by their middles; the opening of a cell is the upper quartile of its bonds, so
/// that neither bonds beside the crack nor the most oblique ones decide. Neighbouring cells belong
/// to one crack unless they open by less than a tenth of its maximum, or the cells between two
/// maxima by less than half of the smaller one. Cracks that open by less than a tenth of the widest
/// are left out.
/// \param neighbourhoods  bonds of each particle (bonds_of_particles)
/// \param spacing         mean distance of neighbouring particles [length]
std::vector<GrownCrack> list_cracks(const Network& network, const Csr& neighbourhoods,
                                    const CrackOpenings& openings, double spacing);

}  // namespace perilink
