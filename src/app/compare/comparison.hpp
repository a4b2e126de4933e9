#pragma once

#include <limits>
#include <string>
#include <vector>

#include "app/compare/run_result.hpp"

namespace perilink {

/// One quantity of two results. Missing values are not-a-number.
struct ComparedQuantity {
  std::string name;
  std::string unit;  ///< empty: none or unknown
  double a = std::numeric_limits<double>::quiet_NaN();
  double b = std::numeric_limits<double>::quiet_NaN();
  /// Value of a quantity that describes both results together, such as a distance.
  double between = std::numeric_limits<double>::quiet_NaN();

  /// 100 (b − a) / |a|; 0 where both are zero; not-a-number where |a| is round-off relative to |b|.
  double difference_percent() const;
};

/// Comparison of two results; docs/compare.md defines each quantity.
struct Comparison {
  std::vector<ComparedQuantity> quantities;
  std::vector<std::string> notes;
};

Comparison compare_results(const RunResult& a, const RunResult& b);

/// Returns the comparison as a text table with six digits and dashes for missing values.
std::string comparison_report(const RunResult& a, const RunResult& b, const Comparison& comparison);

/// Returns the comparison as comma-separated values with all digits; missing values are empty.
std::string comparison_csv(const RunResult& a, const RunResult& b, const Comparison& comparison);

}  // namespace perilink
