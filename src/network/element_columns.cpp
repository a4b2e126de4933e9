#include "network/element_columns.hpp"

#include <stdexcept>

namespace perilink {

void keep_elements(Network& network, std::span<const std::uint8_t> keep) {
  keep_bonds(network.bonds, keep);
  const auto keep_values = [&](auto& values) {
    if (values.size() > keep.size()) throw std::logic_error("more values than elements");
    std::size_t next = 0;
    for (std::size_t e = 0; e < values.size(); ++e) {
      if (keep[e]) values[next++] = values[e];
    }
    values.resize(next);
  };
  for_each_element_column([&](auto list, auto) { keep_values(list(network)); });
  keep_values(network.materials_of);
}

}  // namespace perilink
