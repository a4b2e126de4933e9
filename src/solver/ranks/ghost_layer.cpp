#include "solver/ranks.hpp"

#include <utility>

namespace perilink {

GhostLayer::GhostLayer(Ranks& ranks, const Ghosts& ghosts) : ranks_(ranks) {
  std::vector<Border> borders(static_cast<std::size_t>(ranks.count()));
  std::vector<std::vector<Index>> wanted(borders.size());
  for (std::size_t g = 0; g < ghosts.owners.size(); ++g) {
    borders[ghosts.owners[g]].in.push_back(ghosts.places[g]);
    wanted[ghosts.owners[g]].push_back(ghosts.numbers[g]);
  }
  std::vector<Exchange> all;
  for (int rank = 0; rank < ranks.count(); ++rank) {
    if (rank == ranks.own()) continue;
    all.emplace_back().rank = rank;
    all.back().out.put(wanted[rank]);
  }
  ranks.exchange(all);
  for (Exchange& each : all) {
    Border& border = borders[each.rank];
    each.in.get(border.out);
    if (border.out.empty() && border.in.empty()) continue;
    borders_.push_back(std::move(border));
    messages_.emplace_back().rank = each.rank;
  }
}

void GhostLayer::update(int width, std::initializer_list<std::span<double>> fields) {
  const auto size = static_cast<std::size_t>(width);
  for (std::size_t k = 0; k < borders_.size(); ++k) {
    Parcel& out = messages_[k].out;
    out.clear();
    for (const std::span<const double> field : fields) {
      for (const Index particle : borders_[k].out) {
        out.put_values(field.subspan(particle * size, size));
      }
    }
  }
  ranks_.exchange(messages_);
  for (std::size_t k = 0; k < borders_.size(); ++k) {
    for (const std::span<double> field : fields) {
      for (const Index particle : borders_[k].in) {
        messages_[k].in.get_values(field.subspan(particle * size, size));
      }
    }
  }
}

}  // namespace perilink
