#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/types.hpp"
#include "network/network.hpp"

namespace perilink {

/// Activates the compressive branch of bonds. It is inactive until such a bond at one of their
/// particles has its first event in tension. It then stays active: the law is for growing loads.
class CrushingBonds {
 public:
  explicit CrushingBonds(const Network& network);

  /// Activates the bonds at both ends of a bond.
  /// \param stretched  a bond that had its first event in tension
  /// \return activated bonds, particle by particle; a bond may occur twice
  std::vector<Index> wake(Index stretched);
  bool is_active(Index bond) const {
    return awake_[network_.bonds.first[bond]] != 0 || awake_[network_.bonds.second[bond]] != 0;
  }

 private:
  const Network& network_;
  std::vector<std::size_t> begin_;  ///< into bonds_, per particle, with the end
  std::vector<Index> bonds_;
  std::vector<std::uint8_t> awake_;  ///< flag per particle
};

/// Returns whether a motion shortens an element.
/// \param motion  shape (particles, width)
bool is_shorter(const Network& network, Index element, std::span<const double> motion);

}  // namespace perilink
