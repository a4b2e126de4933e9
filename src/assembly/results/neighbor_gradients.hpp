#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

#include "discretization/particles.hpp"

namespace perilink {

/// Gradients of a motion at particles from the displacements of their neighbours, which are linear
/// in these: sums with weights that depend on where the neighbours lie alone. Particles of lattices
/// lie in few kinds of surroundings, so the weights found for one are taken for all that differ
/// from it by the round-off of positions. What comes out depends on which particle was asked first,
/// in the last digits: results are those of blocks, each with a table of its own, whatever the
/// number of threads.
template <int Dim>
class NeighborGradients {
 public:
  using Gradient = Eigen::Matrix<double, Dim, Dim>;  ///< row a, column b: du_a / dx_b

  /// Finds the weights.
  /// \param offsets  from the particle to the neighbours, shape (neighbors, Dim) [length]
  /// \param weights  as many of them [1/length]
  /// \return whether the neighbours settle the gradient
  using Fit = bool (*)(std::span<const double> offsets, std::span<double> weights);

  /// Particles of a block.
  static constexpr Index block = 4096;

  /// \param motion  shape (particles, width), displacements first
  NeighborGradients(const Particles& particles, std::span<const double> motion, int width, Fit fit);

  /// \return whether the neighbours settle it; else it stays as it was
  bool find(Index particle, std::span<const Index> neighbors, Gradient& gradient);

 private:
  /// Surroundings of a particle.
  struct Kind {
    std::vector<double> offsets, weights;  ///< shape (neighbors, Dim)
    double reach = 0.0;                    ///< largest component of an offset [length]
    bool settled = false;
  };

  const Kind& kind_of(Index particle, std::span<const Index> neighbors);
  bool is_like(const Kind& kind, Index particle) const;
  void fit(Kind& kind) const;

  const Particles& particles_;
  std::span<const double> motion_;
  std::size_t width_;
  Fit fit_;
  std::vector<double> offsets_;                    ///< those of the present particle
  std::unordered_map<std::uint64_t, Kind> kinds_;  ///< by what the numbers of neighbours add up to
  Kind single_;                                    ///< where the table is full, or has another
};

}  // namespace perilink
