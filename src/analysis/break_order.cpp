#include "analysis/break_order.hpp"

#include <algorithm>

namespace perilink {

const std::vector<Index>& BreakOrder::so_far() {
  std::vector<std::pair<Index, Index>> latest;
  for (auto& block : of_blocks_) {
    latest.insert(latest.end(), block.begin(), block.end());
    block.clear();
  }
  std::sort(latest.begin(), latest.end());
  latest.erase(std::unique(latest.begin(), latest.end()), latest.end());
  for (const auto& [step, number] : latest) order_.push_back(number);
  return order_;
}

}  // namespace perilink
