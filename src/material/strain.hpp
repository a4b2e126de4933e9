#pragma once

namespace perilink {

/// How the deformation of a bond is measured.
enum class Strain {
  small,  ///< extension along its direction before loading, as in the implicit mode
  green,  ///< Green–Lagrange stretch, with the force along its present direction; truss bonds only
};

}  // namespace perilink
