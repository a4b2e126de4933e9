#pragma once

#include "network/frame.hpp"
#include "network/network.hpp"
#include "network/secants.hpp"

namespace perilink {

/// Entries of a truss's stiffness between two of its ends, 0 the first and 1 the second
/// [force/length].
template <int Dim>
struct Truss {
  static constexpr int dim = Dim, width = Dim;

  Truss(const Network& network, Index element, Secants secants)
      : n(network.bonds.direction(element).data()),
        k(network.stiffness[element] * secants.axial(element)) {}

  double entry(int row_end, int col_end, int row, int col) const {
    return (row_end == col_end ? k : -k) * n[row] * n[col];
  }

  const double* n;
  double k;
};

template <int Dim>
struct Frame {
  using Modes = FrameModes<Dim>;
  static constexpr int dim = Dim, width = Modes::width;

  /// Flattened: the modes must be rounded as in the rest of this file, not as in a function
  /// compiled for other instruction sets.
  [[gnu::flatten]] Frame(const Network& network, Index element, Secants secants)
      : modes(frame_modes<Dim>(network, element)) {
    modes.stiffness[0] *= secants.axial(element);
    for (int m = 1; m < Modes::count; ++m) modes.stiffness[m] *= secants[element];
  }

  double entry(int row_end, int col_end, int row, int col) const {
    const auto& rows = row_end == 0 ? modes.first : modes.second;
    const auto& cols = col_end == 0 ? modes.first : modes.second;
    double value = 0.0;
    for (int m = 0; m < Modes::count; ++m) {
      value += modes.stiffness[m] * rows[m][row] * cols[m][col];
    }
    return value;
  }

  Modes modes;
};

}  // namespace perilink
