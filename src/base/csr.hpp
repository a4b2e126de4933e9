#pragma once

#include <numeric>
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

/// Sorts items into rows. Each row keeps the items in the order of the visits.
/// \param visit_items  calls act(row, item) for every item; is called twice and must visit in one
///     order
template <class VisitItems>
Csr sorted_into_rows(Index num_rows, VisitItems visit_items) {
  Csr rows;
  rows.offsets.assign(static_cast<std::size_t>(num_rows) + 1, 0);
  visit_items([&](Index row, Index) { ++rows.offsets[row + 1]; });
  std::partial_sum(rows.offsets.begin(), rows.offsets.end(), rows.offsets.begin());
  rows.values.resize(rows.offsets.back());
  std::vector<Index> next(rows.offsets.begin(), rows.offsets.end() - 1);
  visit_items([&](Index row, Index item) { rows.values[next[row]++] = item; });
  return rows;
}

}  // namespace perilink
