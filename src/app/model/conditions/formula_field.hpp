#pragma once

#include <span>
#include <string>
#include <vector>

#include "io/case/case_file.hpp"

namespace perilink {

/// Bounds of what formulas may give, as for the numbers of a case: powers of others would leave the
/// range of double precision. Loads that are smaller everywhere count as none.
inline constexpr double largest_value = 1e50;
inline constexpr double smallest_load = 1e-50;

/// Values of a key of the case as functions of the reference position.
class PositionField {
 public:
  /// \param input  must outlive this object; its reader has checked the formulas
  /// \param key    for messages, "loads[1].body_force"
  PositionField(const CaseFile& input, std::string key, std::span<const Expression> components);

  /// One value per component, two-dimensional bodies leave the third zero.
  /// \param position  size dim [length]
  /// \throws InputError  where a formula is not finite
  Vector3 at(std::span<const double> position) const;

 private:
  const CaseFile& input_;
  std::string key_;
  std::vector<Formula> formulas_;
};

}  // namespace perilink
