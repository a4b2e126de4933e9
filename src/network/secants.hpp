#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "base/types.hpp"

namespace perilink {

/// Present stiffness of every element as a fraction of the intact one [-]. That against a change of
/// length may differ from the rest: a damaged bond that closes is as stiff as an intact one, but
/// shears and bends as it did before.
class Secants {
 public:
  Secants() = default;
  Secants(const std::vector<double>& all) : all_(all), axial_(all) {}
  Secants(std::span<const double> all) : all_(all), axial_(all) {}
  Secants(std::span<const double> all, std::span<const double> axial) : all_(all), axial_(axial) {}

  std::size_t size() const { return all_.size(); }
  auto begin() const { return all_.begin(); }
  auto end() const { return all_.end(); }

  /// What damage has left.
  double operator[](Index element) const { return all_[element]; }
  double axial(Index element) const { return axial_[element]; }

 private:
  std::span<const double> all_, axial_;
};

}  // namespace perilink
