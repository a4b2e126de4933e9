#pragma once

#include <string>

#include "base/error.hpp"
#include "base/types.hpp"

namespace perilink {

/// Error: a matrix is not positive definite, so a part can move without resistance.
class NotPositiveDefinite : public SolverError {
 public:
  /// \param unknown  an unknown that can move, or no_index
  explicit NotPositiveDefinite(const std::string& message, Index unknown = no_index)
      : SolverError(message), unknown_(unknown) {}
  Index unknown() const { return unknown_; }

 private:
  Index unknown_;
};

}  // namespace perilink
