#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

#include "base/types.hpp"

namespace perilink {

/// Secant stiffness ratio of every element, present over intact stiffness [-]. The axial ratio may
/// differ from the ratio for shear and bending. A closed damaged bond has intact axial stiffness
/// with the damaged shear and bending. Bonds with shear retention keep shear and bending until they
/// break. An empty object means that all elements are intact.
class Secants {
 public:
  Secants() = default;
  Secants(const std::vector<double>& all) : all_(all), axial_(all) {}
  Secants(std::span<const double> all) : all_(all), axial_(all) {}
  Secants(std::span<const double> all, std::span<const double> axial) : all_(all), axial_(axial) {}

  std::size_t size() const { return all_.size(); }
  auto begin() const { return all_.begin(); }
  auto end() const { return all_.end(); }

  /// Returns the ratio for shear and bending.
  double operator[](Index element) const { return all_.empty() ? 1.0 : all_[element]; }
  double axial(Index element) const { return axial_.empty() ? 1.0 : axial_[element]; }
  /// Returns the smaller ratio: the damage ratio of a closed bond, the axial ratio of a bond with
  /// shear retention.
  double least(Index element) const { return std::min((*this)[element], axial(element)); }

 private:
  std::span<const double> all_, axial_;
};

}  // namespace perilink
