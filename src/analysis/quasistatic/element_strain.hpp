#pragma once

#include <span>
#include <vector>

#include "discretization/particles.hpp"

namespace perilink {

/// Mean strain of an element that carries particles: that of the linear motion nearest to theirs,
/// by least squares. Particles in one line or plane tell the strain in it alone.
class ElementStrain {
 public:
  /// \param inside  particles of the element that count
  ElementStrain(const Particles& particles, Index number, std::span<const Index> inside);

  Index number() const { return number_; }

  /// Its largest principal value [-].
  /// \param motion  shape (particles, width)
  double principal(std::span<const double> motion, int width) const;

 private:
  int dim_;
  Index number_;
  std::vector<Index> inside_;
  std::vector<double> gradient_;  ///< that each particle adds by its motion, shape (inside, dim)
};

}  // namespace perilink
