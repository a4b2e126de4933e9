#pragma once

namespace perilink {

/// How the equations of an equilibrium are solved: by a factor, by conjugate gradients without one,
/// or by what serves the body at hand.
enum class LinearSolver { automatic, direct, iterative };

}  // namespace perilink
