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

/// The finite elements that go on carrying particles. A bond with a carried end does not fail: it
/// has an alert instead, at a fraction of its limit, and what comes next in the search is the
/// element around it, which lets go of its particles. So every bond that fails has two free ends,
/// and none that might have failed before it is left in an element. Where the body asks for it, the
/// mean principal strain of the element gives the alert instead (Gerstle, Sau & Aguilera 2007,
/// section 7).
class HostRelease {
 public:
  /// \param body  must outlive this
  HostRelease(const Network& network, const EmbeddedBody& body);

  bool is_embedded(Index bond) const {
    return host_[network_.bonds.first[bond]] != no_index ||
           host_[network_.bonds.second[bond]] != no_index;
  }
  /// Per particle, the element that carries it, or no_index.
  const std::vector<Index>& hosts() const { return host_; }
  /// Bonds that are carried now, ascending.
  std::vector<Index> embedded_bonds() const;

  /// How the particles move where more of them are gripped than at first, as in a later stage.
  /// \param free  how they would without elements, where they move freely; must outlive this
  const Unknowns& hold(const Unknowns& free);

  /// Fraction of its limit at which a carried bond gives the alert; the whole of it where strains
  /// should have come first.
  double release_threshold() const;
  /// Whether strains of elements give the alert.
  bool strains() const { return body_.release_strain.has_value(); }
  struct Strained {
    std::vector<std::uint8_t> elements;  ///< per element
    double load_factor;                  ///< when the first is; infinity: there is none
  };
  /// The whole elements whose strain comes to the alert first, of those with bonds that can fail.
  /// \param motion    at load factor 1, shape (particles, width); right where bonds can fail
  /// \param fraction  elements that have come this near to it then count too
  Strained strained(std::span<const double> motion, double fraction);

  /// Per element, whether it carries one of these bonds.
  std::vector<std::uint8_t> hosts_of(std::span<const Index> bonds) const;

  /// Converts these elements, and those around them.
  /// \return how the particles move from now on, valid until the call after the next one
  const Unknowns& convert(const std::vector<std::uint8_t>& alarmed);
  /// Bonds that the last call set free, ascending.
  const std::vector<Index>& freed() const { return freed_; }
  /// Per element, whether it carries its particles.
  const std::vector<std::uint8_t>& whole() const { return whole_; }
  /// Elements that carry particles.
  Index num_whole() const { return num_whole_; }

 private:
  std::vector<std::uint8_t> with_buffer_zone(const std::vector<std::uint8_t>& alarmed) const;
  bool is_near(Index element, Index other) const;
  void watch_strains();

  const Network& network_;
  const EmbeddedBody& body_;
  const Unknowns* free_;
  std::vector<std::uint8_t> whole_;
  std::vector<Index> host_;  ///< per particle
  Index num_whole_ = 0;
  std::vector<Index> by_lower_x_;  ///< elements in the order of their lower ends along x
  double widest_ = 0.0;            ///< largest width of an element along x [length]
  std::vector<Index> freed_;
  std::optional<std::vector<ElementStrain>> strains_;  ///< where bonds can fail, once asked for
  std::unique_ptr<Unknowns> present_, former_;
};

}  // namespace perilink
