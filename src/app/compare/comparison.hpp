#pragma once

#include <limits>
#include <string>
#include <vector>

#include "app/compare/run_result.hpp"

namespace perilink {

/// One quantity of two results. What is missing is not-a-number.
struct ComparedQuantity {
  std::string name;
  std::string unit;  ///< empty: none, or not known
  double a = std::numeric_limits<double>::quiet_NaN();
  double b = std::numeric_limits<double>::quiet_NaN();
  /// Value of a quantity that belongs to both.
  double between = std::numeric_limits<double>::quiet_NaN();

  /// 100 (b − a) / |a|, 0 where both are zero; not a number where a is none beside b.
  double difference_percent() const;
};

/// Two results side by side; docs/compare.md says what each quantity is.
struct Comparison {
  std::vector<ComparedQuantity> quantities;
  std::vector<std::string> notes;
};

Comparison compare_results(const RunResult& a, const RunResult& b);

/// The table for people; numbers with six digits, dashes for what is missing.
std::string comparison_report(const RunResult& a, const RunResult& b, const Comparison& comparison);

/// The same as comma-separated values with all digits; what is missing is empty.
std::string comparison_csv(const RunResult& a, const RunResult& b, const Comparison& comparison);

}  // namespace perilink
