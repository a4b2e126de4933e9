#pragma once

#include <cstddef>
#include <span>

#include "analysis/quasistatic/observer.hpp"

/// \file
/// When a crack has gone through a body whose parts hold on: pads that cannot break carry both.

namespace perilink {

/// Energy that events in tension take from a bond until its secant is this, over half of its
/// stiffness times the square of its extension at the critical stretch [-].
double energy_until(const BondLaw& law, double secant);

/// Number of rows until a crack spans nine tenths of the body, along one axis in the plane and two
/// in space; all rows where none does. A crack is a set of bonds that share particles and have lost
/// half of their fracture energy or more. Bonds with a law in compression do not count.
/// \param rows  of single events
std::size_t rows_before_through_crack(const Network& network, std::span<const StepRecord> rows);

}  // namespace perilink
