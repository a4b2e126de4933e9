#pragma once

#include "model/model.hpp"

namespace perilink {

/// Prints particles, bonds, their strength, the loads at load factor 1 and the positions of gauges.
/// \param damage  whether bonds may break in the run
void print_sizes(const Model& model, bool damage = false);

}  // namespace perilink
