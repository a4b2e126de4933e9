#pragma once

#include <span>
#include <vector>

#include "discretization/particles.hpp"

namespace perilink {

/// Mean strain of a host: strain of the linear motion that fits its particles best, by least
/// squares. Particles on one line or plane give the strain within it only.
class ElementStrain {
 public:
  /// \param inside  particles of the element that enter the fit
  ElementStrain(const Particles& particles, Index number, std::span<const Index> inside);

  Index number() const { return number_; }

  /// Returns the largest principal strain [-].
  /// \param motion  shape (particles, width)
  double principal(std::span<const double> motion, int width) const;

 private:
  int dim_;
  Index number_;
  std::vector<Index> inside_;
  /// Weight of each particle's motion in the displacement gradient, shape (inside, dim).
  std::vector<double> gradient_;
};

}  // namespace perilink
