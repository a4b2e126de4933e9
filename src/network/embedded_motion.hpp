#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "discretization/hosts/hosts.hpp"
#include "network/unknowns.hpp"

namespace perilink {

/// A body whose particles finite elements carry where nothing breaks.
struct EmbeddedBody {
  Hosts hosts;
  Unknowns free;                    ///< how particles move that nothing carries
  std::vector<std::uint8_t> whole;  ///< per element: whether it carries its particles at first
  /// An element is converted before the next event where one of its bonds has come to this fraction
  /// of its limit, at the load factor of that event [-].
  double release_threshold = 0.5;
  /// Instead: where its mean principal strain has come to this [-].
  std::optional<double> release_strain = {};
  double buffer_zone =
      0.0;  ///< elements within this distance of one that converts do so too [length]
};

/// Elements that supports hold as their particles are held. A node is held along a component where
/// held particles of an element leave it no other motion than zero, as those along an edge do. With
/// its held nodes an element must let all its other particles move, and none that is held or
/// driven: others would make particles stiffer than they are, or softer.
/// \return per element, nonzero where it may carry
std::vector<std::uint8_t> fit_supports(const Hosts& hosts, const Unknowns& free);

/// The first whole element of each particle; no_index: it is free.
std::vector<Index> host_of_particles(const Hosts& hosts, std::span<const std::uint8_t> whole,
                                     Index num_particles);

/// The motion of all particles: free ones by unknowns of their own, in the order of the particles,
/// then those of nodes that carry.
/// \param free   how particles move that nothing carries
/// \param whole  per element, of those that fit_supports() lets pass
Unknowns embedded_motion(const Hosts& hosts, const Unknowns& free,
                         std::span<const std::uint8_t> whole);

/// Moves what is out of balance at particles that elements constrain to the held particles of these
/// elements. Only the forces on nodes are in balance: those on free nodes are zero, those on held
/// nodes become forces on the held particles that do the same work in every motion of the nodes.
/// \param free    how particles move without elements
/// \param whole   per element: whether it constrains its particles
/// \param loads   shape (particles, width)
/// \param forces  that hold the particles so, loads included; shape (particles, width)
void pass_to_held(const Hosts& hosts, const Unknowns& free, std::span<const std::uint8_t> whole,
                  std::span<const double> loads, std::span<double> forces);

}  // namespace perilink
