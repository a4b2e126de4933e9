#pragma once

#include <span>

#include "network/network.hpp"
#include "network/secants.hpp"

namespace perilink {

/// Tells when a body that can only be compressed, as one that is crushed between closed bonds, has
/// left the small strains that the analysis stands on.
class StrainWatch {
 public:
  explicit StrainWatch(const Network& network) : network_(network) {}

  /// Whether to look, which costs a pass over the bonds: where the motion is twice as large as at
  /// the last look, or could bring the shortest bond to its limit, and at every hundredth event.
  /// \param motion  load factor or displacement: what grows with the motion of the body
  bool is_due(double motion);

  /// Other loads grow from now on.
  void restart() { looked_at_ = 0.0; }

  /// Whether a bond of the solid that holds, and breaks by tension alone, is shorter by more than a
  /// tenth, or by ten times the stretch at which it begins to fail where that is more.
  /// \param motion  shape (particles, width)
  /// \param factor  by which it counts
  bool is_beyond(std::span<const double> motion, double factor, const Secants& secants);

 private:
  const Network& network_;
  double looked_at_ = 0.0;
  double due_at_ = 0.0;  ///< size of the motion at which to look next
  int events_ = 0;       ///< since the last look
};

}  // namespace perilink
