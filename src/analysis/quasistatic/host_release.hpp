#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "analysis/quasistatic/element_strain.hpp"
#include "network/embedded_motion.hpp"
#include "network/network.hpp"

namespace perilink {

/// Tracks the active hosts: finite elements that constrain their particles. A bond with an embedded
/// end does not fail. At the release threshold, a fraction of its limit, its hosts release their
/// particles. Every bond that fails therefore has two free ends, and no embedded bond can have
/// failed before it. Bodies may use the mean principal strain of the host as threshold instead
/// (Gerstle, Sau & Aguilera 2007, section 7).
class HostRelease {
 public:
  /// \param body  must outlive this object
  HostRelease(const Network& network, const EmbeddedBody& body)
      : HostRelease(network, body, body.whole) {}
  /// \param whole  flag per element: it is an active host now
  HostRelease(const Network& network, const EmbeddedBody& body, std::vector<std::uint8_t> whole);

  bool is_embedded(Index bond) const {
    return host_[network_.bonds.first[bond]] != no_index ||
           host_[network_.bonds.second[bond]] != no_index;
  }
  /// Returns the active host of each particle, or no_index.
  const std::vector<Index>& hosts() const { return host_; }
  /// Returns the bonds with an embedded end, ascending.
  std::vector<Index> embedded_bonds() const;

  /// Returns how the particles move once more of them are clamped, as in a later stage.
  /// \param free  motion of the particles without hosts; must outlive this object
  const Unknowns& hold(const Unknowns& free);

  /// Returns the fraction of its limit at which an embedded bond triggers a release [-]; 1 if
  /// strains trigger releases, which should come first.
  double release_threshold() const;
  /// Returns whether strains of hosts trigger releases.
  bool strains() const { return body_.release_strain.has_value(); }
  struct Strained {
    std::vector<std::uint8_t> elements;  ///< flag per element
    double load_factor;                  ///< first release; infinity: there is none
  };
  /// Finds the active hosts that reach the release strain first, among those with bonds that can
  /// fail.
  /// \param motion    at load factor 1, shape (particles, width), current where bonds can fail
  /// \param fraction  includes hosts with this fraction of the largest strain
  Strained strained(std::span<const double> motion, double fraction);

  /// Returns a flag per element: it hosts an end of one of these bonds.
  std::vector<std::uint8_t> hosts_of(std::span<const Index> bonds) const;

  /// Releases the particles of these hosts and of the hosts in the buffer zone around them.
  /// \return motion of the particles from now on, valid until the call after the next one
  const Unknowns& convert(const std::vector<std::uint8_t>& alarmed);
  /// Returns the bonds that the last convert() freed, ascending.
  const std::vector<Index>& freed() const { return freed_; }
  /// Returns a flag per element: it is an active host.
  const std::vector<std::uint8_t>& whole() const { return whole_; }
  /// Returns the number of active hosts.
  Index num_whole() const { return num_whole_; }

 private:
  std::vector<std::uint8_t> with_buffer_zone(const std::vector<std::uint8_t>& alarmed) const;
  bool is_near(Index element, Index other) const;
  void watch_strains();

  const Network& network_;
  const EmbeddedBody& body_;
  const Unknowns* free_;
  std::vector<std::uint8_t> whole_;
  std::vector<Index> host_;  ///< active host per particle, or no_index
  Index num_whole_ = 0;
  std::vector<Index> by_lower_x_;  ///< elements sorted by their lower ends along x
  double widest_ = 0.0;            ///< largest width of an element along x [length]
  std::vector<Index> freed_;
  /// Hosts with bonds that can fail; made at first use.
  std::optional<std::vector<ElementStrain>> strains_;
  std::unique_ptr<Unknowns> present_, former_;
};

}  // namespace perilink
