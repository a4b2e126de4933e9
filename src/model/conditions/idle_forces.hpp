#pragma once

#include <string>
#include <vector>

#include "model/conditions/supports.hpp"
#include "model/model.hpp"

namespace perilink {

/// Notes forces along prescribed displacements, which have no effect.
void note_idle_forces(const Network& network, const Loads& loads, const Prescription& prescription,
                      std::vector<std::string>& notes);

}  // namespace perilink
