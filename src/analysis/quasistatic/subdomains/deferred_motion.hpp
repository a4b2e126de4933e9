#pragma once

#include <algorithm>
#include <array>
#include <vector>

#include "base/block.hpp"
#include "network/unknowns.hpp"

namespace perilink {

/// Displacements whose last steps are known as combinations of columns, and not yet added to all
/// particles: a search that asks for a few of them adds them there alone.
struct DeferredMotion {
  const Unknowns* unknowns = nullptr;
  const std::vector<double>* solution = nullptr;  ///< q without these steps
  std::vector<double>* displacement = nullptr;    ///< with them where looked at, (particles, width)
  const std::vector<BlockVector<double>>* blocks = nullptr;  ///< columns, BoxFactor::blocks_
  // No matrices of Eigen here: their memory depends on the processor that a file is compiled for.
  std::vector<double> steps;  ///< per column: what is missing of it in the solution
  std::vector<double> moved;  ///< per column: sizes of all steps so far
  int changes = 0;            ///< steps so far
  int restarts = 0;           ///< so often the solution has changed in other ways
  int renewals = 0;           ///< so often columns have gone or become others

  /// What the displacements at so many slots from one on, three at most, lack of them.
  std::array<double, 3> steps_at(std::size_t slot, std::size_t count) const {
    constexpr int lanes = 8;
    constexpr std::size_t ahead = 4;  // rows of other blocks are far away in memory
    double part[3][lanes] = {};
    const double* step = steps.data();
    for (std::size_t b = 0; b * block_width < steps.size(); ++b, step += block_width) {
      const double* column = (*blocks)[b].data() + slot * block_width;
      if (b + ahead < blocks->size()) {
        const double* later = (*blocks)[b + ahead].data() + slot * block_width;
        for (std::size_t k = 0; k < count * block_width; k += lanes) __builtin_prefetch(later + k);
      }
      for (std::size_t a = 0; a < count; ++a, column += block_width) {
        for (int c = 0; c < block_width; c += lanes) {
          for (int k = 0; k < lanes; ++k) part[a][k] += column[c + k] * step[c + k];
        }
      }
    }
    std::array<double, 3> sums{};
    for (std::size_t a = 0; a < count; ++a) {
      for (const double lane : part[a]) sums[a] += lane;
    }
    return sums;
  }

  /// The columns go.
  void drop() {
    steps.clear();
    moved.clear();
    ++renewals;
  }

  bool is_behind() const {
    return std::ranges::any_of(steps, [](double step) { return step != 0.0; });
  }
};

}  // namespace perilink
