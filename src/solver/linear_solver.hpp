#pragma once

namespace perilink {

/// Method that solves the equilibrium equations: factor, conjugate gradients, or the faster of the
/// two for the body.
enum class LinearSolver { automatic, direct, iterative };

}  // namespace perilink
