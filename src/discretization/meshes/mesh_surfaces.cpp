#include "discretization/meshes/mesh_surfaces.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <map>

namespace perilink {
namespace {

/// Shared border of neighbouring sides: a point, or the edge between two points.
using Rim = std::array<Index, 2>;

/// Side at a rim; `first`: it begins there, or runs from the smaller to the larger point.
struct Flank {
  std::size_t side;
  bool first;
};

class MeshSurface {
 public:
  MeshSurface(std::vector<Index>& sides, int dim)
      : sides_(sides), width_(static_cast<std::size_t>(dim)) {
    for (std::size_t side = 0; side < count(); ++side) {
      for (std::size_t k = 0; k < width_; ++k) {
        flanks_[rim(side, k)].push_back({side, begins(side, k)});
      }
    }
  }

  void turn_alike() {
    enum class State : std::uint8_t { unseen, kept, turned };
    std::vector<State> states(count(), State::unseen);
    for (std::size_t start = 0; start < count(); ++start) {
      if (states[start] != State::unseen) continue;
      states[start] = State::kept;
      std::vector<std::size_t> waiting = {start};
      while (!waiting.empty()) {
        const std::size_t own = waiting.back();
        waiting.pop_back();
        for (std::size_t k = 0; k < width_; ++k) {
          const std::vector<Flank>& pair = flanks_.at(rim(own, k));
          if (pair.size() != 2) continue;
          State& other = states[pair[pair[0].side == own ? 1 : 0].side];
          if (other != State::unseen) continue;
          const bool alike = pair[0].first != pair[1].first;
          other = (states[own] == State::turned) == alike ? State::turned : State::kept;
          waiting.push_back(pair[pair[0].side == own ? 1 : 0].side);
        }
      }
    }
    for (std::size_t side = 0; side < count(); ++side) {
      if (states[side] != State::turned) continue;
      std::swap(sides_[width_ * side + width_ - 2], sides_[width_ * side + width_ - 1]);
    }
  }

 private:
  std::size_t count() const { return sides_.size() / width_; }
  Index corner(std::size_t side, std::size_t k) const { return sides_[width_ * side + k % width_]; }
  Rim rim(std::size_t side, std::size_t k) const {
    if (width_ == 2) return {corner(side, k), corner(side, k)};
    return {std::min(corner(side, k), corner(side, k + 1)),
            std::max(corner(side, k), corner(side, k + 1))};
  }
  bool begins(std::size_t side, std::size_t k) const {
    return width_ == 2 ? k == 0 : corner(side, k) < corner(side, k + 1);
  }

  std::vector<Index>& sides_;
  std::size_t width_;
  std::map<Rim, std::vector<Flank>> flanks_;
};

}  // namespace

void turn_alike(std::vector<Index>& sides, int dim) { MeshSurface(sides, dim).turn_alike(); }

}  // namespace perilink
