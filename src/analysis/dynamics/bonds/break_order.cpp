#include "analysis/dynamics/bonds/break_order.hpp"

#include <algorithm>

namespace perilink {

std::vector<BreakOrder::Break> BreakOrder::take_latest() {
  std::vector<Break> latest;
  for (auto& block : of_blocks_) {
    latest.insert(latest.end(), block.begin(), block.end());
    block.clear();
  }
  std::sort(latest.begin(), latest.end());
  return latest;
}

void BreakOrder::count(Index number) {
  const auto place = static_cast<std::size_t>(number);
  if (place >= counted_.size()) counted_.resize(place + 1);
  if (counted_[place]) return;
  counted_[place] = true;
  order_.push_back(number);
}

const std::vector<Index>& BreakOrder::so_far() {
  for (const auto& [step, number] : take_latest()) count(number);
  return order_;
}

void BreakOrder::restore(const std::vector<Index>& order) {
  for (const Index number : order) count(number);
}

}  // namespace perilink
