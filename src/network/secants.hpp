#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

#include "base/types.hpp"

namespace perilink {

/// Present stiffness of every element as a fraction of the intact one [-]. That against a change of
/// length may differ from the rest: a damaged bond that closes is as stiff as an intact one, but
/// shears and bends as it did before, and there are bonds that keep shear and bending until they
/// break. None given: all elements are intact.
class Secants {
 public:
  Secants() = default;
  Secants(const std::vector<double>& all) : all_(all), axial_(all) {}
  Secants(std::span<const double> all) : all_(all), axial_(all) {}
  Secants(std::span<const double> all, std::span<const double> axial) : all_(all), axial_(axial) {}

  std::size_t size() const { return all_.size(); }
  auto begin() const { return all_.begin(); }
  auto end() const { return all_.end(); }

  /// What damage has left against shear and bending.
  double operator[](Index element) const { return all_.empty() ? 1.0 : all_[element]; }
  double axial(Index element) const { return axial_.empty() ? 1.0 : axial_[element]; }
  /// The smaller of the two: of a bond that closes what damage has left, of one that keeps its
  /// shear the stiffness against a change of length.
  double least(Index element) const { return std::min((*this)[element], axial(element)); }

 private:
  std::span<const double> all_, axial_;
};

}  // namespace perilink
