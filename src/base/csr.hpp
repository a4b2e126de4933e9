#pragma once

#include <span>
#include <vector>

#include "base/types.hpp"

namespace perilink {

/// Lists of different lengths in one array (compressed rows): row i holds
/// values[offsets[i]] … values[offsets[i + 1] - 1].
struct Csr {
  std::vector<Index> offsets{0};  ///< size rows + 1
  std::vector<Index> values;

  Index rows() const { return static_cast<Index>(offsets.size()) - 1; }
  std::span<const Index> row(Index i) const {
    return {values.data() + offsets[i], static_cast<std::size_t>(offsets[i + 1] - offsets[i])};
  }
};

}  // namespace perilink
