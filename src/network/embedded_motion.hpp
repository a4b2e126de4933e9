#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "discretization/hosts/hosts.hpp"
#include "network/unknowns.hpp"

namespace perilink {

/// A body with embedded particles: finite elements constrain them where no bond breaks.
struct EmbeddedBody {
  Hosts hosts;
  Unknowns free;                    ///< motion of the particles without hosts
  std::vector<std::uint8_t> whole;  ///< per element: nonzero if the host is active at first
  /// Release threshold [-]. A host is released before the next event if one of its bonds reaches
  /// this fraction of its limit at that event's load factor.
  double release_threshold = 0.5;
  /// Release threshold by the mean principal strain of the host [-], in place of
  /// `release_threshold`.
  std::optional<double> release_strain = {};
  double buffer_zone =
      0.0;  ///< buffer zone: hosts within this distance of a released one are released too [length]
};

/// Returns the elements that represent their supports exactly. A node is held along a component if
/// the held particles of an element, such as those along an edge, force its motion to zero. With
/// its held nodes an element must hold exactly its held particles, and it must not contain
/// particles with prescribed motions. Other elements would make the support stiffer or softer.
/// \return per element, nonzero if it may be a host
std::vector<std::uint8_t> fit_supports(const Hosts& hosts, const Unknowns& free);

/// Returns the first active host of each particle, or no_index for a free particle.
std::vector<Index> host_of_particles(const Hosts& hosts, std::span<const std::uint8_t> whole,
                                     Index num_particles);

/// Returns the motion of all particles. Free particles have unknowns of their own, in the order of
/// the particles; the unknowns of host nodes follow.
/// \param free   motion of the particles without hosts
/// \param whole  per element, nonzero for active hosts; only elements that fit_supports() accepts
Unknowns embedded_motion(const Hosts& hosts, const Unknowns& free,
                         std::span<const std::uint8_t> whole);

/// Moves the out-of-balance forces of embedded particles to the held particles of their hosts. With
/// hosts only the forces on nodes are in balance: they are zero on free nodes. Forces on held nodes
/// become forces on the held particles with equal work in every motion of the nodes.
/// \param free    motion of the particles without hosts
/// \param whole   per element: nonzero for active hosts
/// \param loads   shape (particles, width)
/// \param forces  forces that hold the particles, loads included; shape (particles, width)
void pass_to_held(const Hosts& hosts, const Unknowns& free, std::span<const std::uint8_t> whole,
                  std::span<const double> loads, std::span<double> forces);

}  // namespace perilink
