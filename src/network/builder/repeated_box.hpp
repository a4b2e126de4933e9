#pragma once

#include <functional>
#include <optional>

#include "discretization/lattices/lattice.hpp"
#include "network/network.hpp"
#include "network/network_input.hpp"

namespace perilink {

/// Returns whether the calibrated bonds of a template box can be repeated in a body. The body must
/// be a box of a lattice in space with one set of elastic constants. It must have at least twice as
/// many particles as the template box with all equivalence classes of places (LatticePattern).
bool repeats_smaller_box(const Body& body, const NetworkInput& input);

/// Returns the bonds and stiffnesses of such a body.
/// \param make  builds the calibrated network of the template box
/// \return empty if the calibration of the template does not preserve symmetry. The caller sets
///     critical stretches; `calibration` is the report of the template box.
std::optional<Network> repeat_smaller_box(
    const Body& body, const NetworkInput& input,
    const std::function<Network(const Body& body, const NetworkInput& input)>& make);

}  // namespace perilink
