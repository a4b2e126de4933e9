#pragma once

#include <span>

#include "network/network.hpp"
#include "network/secants.hpp"

namespace perilink {

/// Tells when a body that can only be compressed, as one that is crushed between closed bonds, has
/// left the small strains that the analysis stands on.
class StrainWatch {
 public:
  explicit StrainWatch(const Network& network);

  /// Whether the load factor is twice as large as when this was last so: to look costs a pass over
  /// the bonds.
  bool is_due(double load_factor);

  /// Other loads grow from now on.
  void restart() { looked_at_ = 0.0; }

  /// Whether a bond that may break, and holds, is shorter by more than a tenth, or by ten times the
  /// largest stretch at which bonds begin to fail where that is more.
  /// \param motion  shape (particles, width)
  /// \param factor  by which it counts
  bool is_beyond(std::span<const double> motion, double factor, const Secants& secants) const;

 private:
  const Network& network_;
  double most_shortening_;  ///< [-]
  double looked_at_ = 0.0;
};

}  // namespace perilink
