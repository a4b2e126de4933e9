#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "network/loaded_network.hpp"
#include "network/network.hpp"
#include "network/secants.hpp"

namespace perilink {

/// A part of the body without connection to the rest.
struct Fragment {
  std::vector<Index> particles;
  int free_modes = 0;  ///< rigid-body modes that prescribed displacements and elastic supports
                       ///< leave free
};

/// Parts of the network that elements connect, but for those that are broken or have no stiffness,
/// in the order of their first particles. Their free modes are not counted.
std::vector<Fragment> connected_parts(const Network& network, Secants secants);

/// Flags components that are held or that elastic supports resist, shape (particles, width).
std::vector<std::uint8_t> held_or_sprung(const Network& network, std::vector<std::uint8_t> held);

/// Connected parts of the network (elements of zero stiffness do not connect) with the number of
/// rigid-body modes that `held` (shape (particles, width)) leaves free in each. Rotations of
/// particles that no bond turns hold nothing.
std::vector<Fragment> find_fragments(const Network& network, const std::vector<std::uint8_t>& held);

/// Returns the number of rigid-body modes of some particles that `held` and bonds to fixed parts
/// leave free.
/// \param bonds  particle and number of each bond
int free_modes(const Network& network, const std::vector<Index>& particles,
               const std::vector<std::uint8_t>& held,
               std::span<const std::pair<Index, Index>> bonds);

/// Returns the rigid-body motions of a fragment that `held` leaves free, each of
/// shape (particles, width). They are zero at other particles and held components, linearly
/// independent, and not scaled. Springs of supports are ignored.
std::vector<std::vector<double>> free_motions(const Network& network, const Fragment& fragment,
                                              const std::vector<std::uint8_t>& held);

/// Whether prescribed values equal a translation in all held components.
/// \param held, values  shape (particles, width)
bool is_translation(const Network& network, const std::vector<std::uint8_t>& held,
                    std::span<const double> values);

/// Whether prescribed values equal a rigid-body motion in all held components, to round-off.
/// \param held, values  shape (particles, width)
bool is_rigid_motion(const Network& network, const std::vector<std::uint8_t>& held,
                     std::span<const double> values);

/// Resultant of the applied loads.
struct LoadResultant {
  std::vector<double> force;   ///< size dim [force]
  std::vector<double> moment;  ///< about the solid's centroid, size 1 in 2D, 3 in 3D [force length]
  double scale = 0.0;          ///< sum of |forces|
};
LoadResultant load_resultant(const Network& network, const Loads& loads);

/// Marks unknowns in `held` that fix exactly the rigid-body modes of a free fragment: three
/// unknowns in 2D, six in 3D. Displacements are preferred to rotations, and particles with
/// unbreakable bonds to others.
void pin_rigid_modes(const Network& network, const Fragment& fragment,
                     std::vector<std::uint8_t>& held);

}  // namespace perilink
