#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

#include "discretization/particles.hpp"

namespace perilink {

/// Computes gradients of a motion at particles. They are linear in the displacements of the
/// neighbours, with weights that depend only on the neighbours' positions. Particles of lattices
/// have few local environments, so weights are reused where offsets differ only by round-off. The
/// last digits depend on the first particle of an environment. Each block of particles has its own
/// table, so results do not depend on the number of threads.
template <int Dim>
class NeighborGradients {
 public:
  using Gradient = Eigen::Matrix<double, Dim, Dim>;  ///< row a, column b: du_a / dx_b

  /// Computes the weights.
  /// \param offsets  from the particle to the neighbours, shape (neighbors, Dim) [length]
  /// \param marks    further numbers that the weights depend on
  /// \param weights  shape (neighbors, Dim), or (neighbors, Dim, Dim, Dim) if coupled: of
  ///                 displacement c in du_a / dx_b [1/length]
  /// \return whether the neighbours determine the gradient
  using Fit = bool (*)(std::span<const double> offsets, std::span<const double> marks,
                       std::span<double> weights);

  /// Number of particles in a block.
  static constexpr Index block = 4096;

  /// \param motion   shape (particles, width), displacements first
  /// \param coupled  du_a / dx_b depends on all components of the displacement, not on u_a alone
  NeighborGradients(const Particles& particles, std::span<const double> motion, int width, Fit fit,
                    bool coupled = false);

  /// Computes the gradient at a particle.
  /// \param marks  further numbers that the weights depend on
  /// \return whether the neighbours determine it; otherwise `gradient` is unchanged
  bool find(Index particle, std::span<const Index> neighbors, Gradient& gradient,
            std::span<const double> marks = {});

 private:
  /// Local environment of a particle.
  struct Kind {
    std::vector<double> offsets, marks, weights;
    double reach = 0.0;  ///< largest component of an offset [length]
    bool settled = false;
  };

  const Kind& kind_of(Index particle, std::span<const Index> neighbors,
                      std::span<const double> marks);
  bool is_like(const Kind& kind, Index particle, std::span<const double> marks) const;
  void fit(Kind& kind, std::span<const double> marks) const;

  const Particles& particles_;
  std::span<const double> motion_;
  std::size_t width_;
  Fit fit_;
  bool coupled_;
  std::vector<double> offsets_;                    ///< offsets of the current particle
  std::unordered_map<std::uint64_t, Kind> kinds_;  ///< by the sum of the neighbours' relative
                                                   ///< numbers
  Kind single_;                                    ///< if the table is full or holds another
                                                   ///< environment for the key
};

}  // namespace perilink
