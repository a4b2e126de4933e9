#pragma once

#include <span>
#include <string>
#include <vector>

#include "io/case/case_file.hpp"

namespace perilink {

/// Limits of formula values, as for numbers of a case; powers of larger ones would overflow double
/// precision. A load that is smaller everywhere counts as zero.
inline constexpr double largest_value = 1e50;
inline constexpr double smallest_load = 1e-50;

/// Formulas of a case key as functions of the reference position.
class PositionField {
 public:
  /// \param input  must outlive this object; the formulas were checked by its reader
  /// \param key    key for messages, "loads[1].body_force"
  PositionField(const CaseFile& input, std::string key, std::span<const Expression> components);

  /// Returns one value per component; the third is zero in two dimensions.
  /// \param position  size dim [length]
  /// \throws InputError  where a formula is not finite
  Vector3 at(std::span<const double> position) const;

 private:
  const CaseFile& input_;
  std::string key_;
  std::vector<Formula> formulas_;
};

}  // namespace perilink
