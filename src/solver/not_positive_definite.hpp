#pragma once

#include <string>

#include "base/error.hpp"
#include "base/types.hpp"

namespace perilink {

/// A matrix that is not positive definite: something can move without resistance.
class NotPositiveDefinite : public SolverError {
 public:
  /// \param unknown  one that can move, where it is known
  explicit NotPositiveDefinite(const std::string& message, Index unknown = no_index)
      : SolverError(message), unknown_(unknown) {}
  Index unknown() const { return unknown_; }

 private:
  Index unknown_;
};

}  // namespace perilink
