#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/types.hpp"
#include "network/network.hpp"

namespace perilink {

/// Bonds whose teeth in compression sleep until a bond of that kind at one of their particles has
/// had its first event in tension. They wake for good: the law is for loads that grow.
class CrushingBonds {
 public:
  explicit CrushingBonds(const Network& network);

  /// \param stretched  a bond that had its first event in tension
  /// \return bonds that wake by it, in the order of the particles; may hold one twice
  std::vector<Index> wake(Index stretched);
  bool is_active(Index bond) const {
    return awake_[network_.bonds.first[bond]] != 0 || awake_[network_.bonds.second[bond]] != 0;
  }

 private:
  const Network& network_;
  std::vector<std::size_t> begin_;  ///< into bonds_, per particle, with the end
  std::vector<Index> bonds_;
  std::vector<std::uint8_t> awake_;  ///< per particle
};

/// Whether the distance between the ends of an element falls by a motion.
/// \param motion  shape (particles, width)
bool is_shorter(const Network& network, Index element, std::span<const double> motion);

}  // namespace perilink
