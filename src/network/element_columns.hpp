#pragma once

#include <cstdint>

#include "network/network.hpp"

namespace perilink {

/// Calls visit(list, value) for each list of a network with one value per element beside the bonds:
/// `list(network)` returns the list, and `value` is that of elements without the property. Lists
/// may be empty. A further property of elements is added here and in Network only.
template <class Visit>
void for_each_element_column(Visit visit) {
  const auto list_of = [](auto member) {
    return [member](auto& network) -> auto& { return network.*member; };
  };
  visit(list_of(&Network::stiffness), 0.0);
  visit(list_of(&Network::bending), 0.0);
  visit(list_of(&Network::bending_ratio), 0.0);
  visit(list_of(&Network::inflection), 0.5);
  visit(list_of(&Network::hinged), std::uint8_t{0});
  visit(list_of(&Network::law_of), Index{0});
  visit(list_of(&Network::critical_stretch), infinity);
}

/// Lengthens lists that are not empty to the number of elements.
inline void complete_columns(Network& network) {
  for_each_element_column([&](auto list, auto value) {
    auto& values = list(network);
    if (!values.empty()) values.resize(network.bonds.first.size(), value);
  });
}

}  // namespace perilink
