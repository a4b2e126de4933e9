#include "analysis/dynamics/bonds/break_order.hpp"

#include <algorithm>

namespace perilink {

const std::vector<Index>& BreakOrder::so_far() {
  std::vector<std::pair<Index, Index>> latest;
  for (auto& block : of_blocks_) {
    latest.insert(latest.end(), block.begin(), block.end());
    block.clear();
  }
  std::sort(latest.begin(), latest.end());
  for (const auto& [step, number] : latest) {
    const auto place = static_cast<std::size_t>(number);
    if (place >= counted_.size()) counted_.resize(place + 1);
    if (counted_[place]) continue;
    counted_[place] = true;
    order_.push_back(number);
  }
  return order_;
}

}  // namespace perilink
