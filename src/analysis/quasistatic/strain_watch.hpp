#pragma once

#include <span>

#include "network/network.hpp"
#include "network/secants.hpp"

namespace perilink {

/// Detects a body that leaves small strains in compression, for example when it is crushed between
/// closed bonds.
class StrainWatch {
 public:
  /// Returns whether is_beyond(), a pass over the bonds, is due. It is due if the motion has
  /// doubled since the last pass, could bring the shortest bond to its limit, and at every
  /// hundredth event.
  /// \param motion  load factor or displacement that grows with the motion of the body
  bool is_due(double motion);

  /// Restarts for another load case.
  void restart() { looked_at_ = 0.0; }

  /// Returns whether a bond of the solid has shortened by more than a tenth, or by ten times its
  /// critical stretch if that is larger. Only unbroken bonds without a law in compression count.
  /// \param motion  shape (particles, width)
  /// \param factor  scales the motion
  bool is_beyond(const Network& network, std::span<const double> motion, double factor,
                 const Secants& secants);

  template <class Archive>
  void serialize(Archive& archive) {
    archive(looked_at_, due_at_, events_);
  }

 private:
  double looked_at_ = 0.0;
  double due_at_ = 0.0;  ///< size of the motion at which the next pass is due
  int events_ = 0;       ///< since the last pass
};

}  // namespace perilink
