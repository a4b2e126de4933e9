#pragma once

#include <string>
#include <vector>

#include "analysis/dynamics/lattice/lattice_analysis.hpp"

namespace perilink::verification {

/// What moves in a run.
struct MovingBody {
  std::string name;  ///< "truss", "frame", "Green", "lattice"
  bool cracks = false;
};
std::vector<MovingBody> moving_bodies();

/// A block in tension, pulled within a few periods; those that crack by more than they bear.
/// \param factor  time step over the computed critical one
/// \param refuse  whether a step above the critical one is refused
/// \throws std::invalid_argument where it is
ExplicitResult run_at(const MovingBody& body, double factor, bool refuse);

/// Whether all that the last row says is finite.
bool is_finite(const ExplicitRecord& record);

}  // namespace perilink::verification
