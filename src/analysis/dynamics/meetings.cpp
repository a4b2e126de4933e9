#include "analysis/dynamics/meetings.hpp"

#include <algorithm>
#include <stdexcept>

namespace perilink {

void Meetings::tell(Wish wish) {
  Parcel parcel;
  parcel.put(wish);
  for (int rank = 1; rank < count_; ++rank) ranks_.send(rank, parcel.bytes());
}

Wish Meetings::receive_wish() {
  const Wish wish = Parcel(ranks_.receive(0)).get<Wish>();
  if (wish < Wish::motion) {
    throw std::logic_error("the first rank has left a run in which others wait for it");
  }
  return wish;
}

void Meetings::add_supports(const std::vector<double>& of_rank, std::vector<double>& of_steps) {
  const std::size_t pieces = of_rank.size() / std::max<std::size_t>(1, of_steps.size());
  for (std::size_t k = 0; k < of_rank.size(); ++k) of_steps[k / pieces] += of_rank[k];
}

void Meetings::forget_supports() {
  supports_.clear();
  steps_ = 0;
}

}  // namespace perilink
