#pragma once

#include <functional>
#include <optional>

#include "discretization/lattices/lattice.hpp"
#include "network/network.hpp"
#include "network/network_input.hpp"

namespace perilink {

/// Whether the calibrated bonds of a body are those of a smaller one over and over: it is a box of
/// a lattice in space with one set of elastic constants, twice as large as the box that has every
/// kind of place (LatticePattern) at least.
bool repeats_smaller_box(const Body& body, const NetworkInput& input);

/// Bonds and stiffnesses of such a body.
/// \param make  makes the calibrated network of the smaller box
/// \return none where its calibration has not made alike what lies alike. Critical stretches are
///         left to the caller, and `calibration` is that of the smaller box.
std::optional<Network> repeat_smaller_box(
    const Body& body, const NetworkInput& input,
    const std::function<Network(const Body& body, const NetworkInput& input)>& make);

}  // namespace perilink
