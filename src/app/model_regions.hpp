#pragma once

#include <string>
#include <vector>

#include "app/configure.hpp"

namespace perilink {

/// Solid particles and bar nodes inside a region, ascending.
/// \param key  of the case that asks, for the message
/// \throws InputError when there is none
std::vector<Index> particles_of_region(const CaseFile& input, const Model& model,
                                       const std::string& region, const std::string& key);

}  // namespace perilink
