#pragma once

#include "app/model/model.hpp"

namespace perilink {

/// Prints what `check` tells of a model: its particles and bonds, their strength, what loads it at
/// load factor 1, and where its gauges are.
/// \param damage  whether bonds may break in the run
void print_sizes(const Model& model, bool damage = false);

}  // namespace perilink
