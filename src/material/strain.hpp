#pragma once

namespace perilink {

/// Measure of the deformation of a bond.
enum class Strain {
  small,  ///< extension along its direction before loading, as in the implicit mode
  green,  ///< Green–Lagrange stretch, with the force along its present direction; truss bonds only
};

}  // namespace perilink
