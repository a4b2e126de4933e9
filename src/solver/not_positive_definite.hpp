#pragma once

#include "base/error.hpp"

namespace perilink {

/// A matrix that is not positive definite: something can move without resistance.
class NotPositiveDefinite : public SolverError {
 public:
  using SolverError::SolverError;
};

}  // namespace perilink
