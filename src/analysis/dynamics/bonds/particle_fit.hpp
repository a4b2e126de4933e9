#pragma once

#include <Eigen/Dense>
#include <array>
#include <cmath>
#include <span>
#include <vector>

#include "base/dense/decompositions.hpp"
#include "base/types.hpp"
#include "discretization/bonds.hpp"
#include "material/j2_plasticity.hpp"

namespace perilink {

/// Strains of particles by a least-squares fit to the stretches of their neighbours' bonds.
template <int Dim>
class ParticleStrains {
 public:
  /// \param halves  bonds of the particle: direction, element, and whether they lead to neighbours
  ///                (mine)
  template <class Half>
  void add(std::span<const Half> halves, const Bonds& bonds) {
    Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(static_cast<Index>(halves.size()), entries);
    for (std::size_t k = 0; k < halves.size(); ++k) {
      if (!halves[k].mine) continue;
      const auto& n = halves[k].n;
      for (int c = 0; c < entries; ++c) {  // entries off the diagonal count twice
        const auto [a, b] = axes[c];
        rows(static_cast<Index>(k), c) = (a == b ? 1.0 : 2.0) * n[a] * n[b];
      }
    }
    const Eigen::MatrixXd inverse = pseudo_inverse(rows);
    double largest = 0.0;
    for (int c = 0; c < entries; ++c) {
      double sum = 0.0;
      for (std::size_t k = 0; k < halves.size(); ++k) {
        sum += std::abs(inverse(c, static_cast<Index>(k))) / bonds.length(halves[k].element);
      }
      largest = std::max(largest, sum);
    }
    for (std::size_t k = 0; k < halves.size(); ++k) {
      for (int c = 0; c < entries; ++c) {
        inverse_.push_back(inverse(c, static_cast<Index>(k)) / bonds.length(halves[k].element));
      }
    }
    largest_.push_back(largest);
    offsets_.push_back(inverse_.size());
  }

  /// Returns the fitted strain of a particle.
  /// \param extension  takes k and returns the extension of the k-th bond of the particle [length]
  template <class Half, class Extension>
  SymmetricTensor fit(Index particle, std::span<const Half> halves,
                      const Extension& extension) const {
    SymmetricTensor strain{};
    const double* inverse = inverse_.data() + offsets_[particle];
    for (std::size_t k = 0; k < halves.size(); ++k, inverse += entries) {
      if (!halves[k].mine) continue;
      const double e = extension(k);
      for (int c = 0; c < entries; ++c) strain[place[c]] += inverse[c] * e;
    }
    return strain;
  }

  /// Returns a bound of principal strains and of the trace over the largest extension [1/length]:
  /// Dim times the bound of an entry.
  double largest_strain(Index particle) const { return Dim * largest_[particle]; }

 private:
  static constexpr int entries = Dim == 2 ? 3 : 6;
  static constexpr std::array<int, 6> place =  // entry in a SymmetricTensor
      Dim == 2 ? std::array<int, 6>{0, 1, 3, 0, 0, 0} : std::array<int, 6>{0, 1, 2, 3, 4, 5};
  static constexpr std::array<std::array<int, 2>, 6> axes =
      Dim == 2
          ? std::array<std::array<int, 2>, 6>{{{0, 0}, {1, 1}, {0, 1}, {}, {}, {}}}
          : std::array<std::array<int, 2>, 6>{{{0, 0}, {1, 1}, {2, 2}, {0, 1}, {1, 2}, {2, 0}}};

  std::vector<double> inverse_;  ///< per bond of each particle, shape (bonds, entries)
  std::vector<std::size_t> offsets_{0};
  std::vector<double> largest_;
};

}  // namespace perilink
