#pragma once

#include <limits>
#include <string>
#include <vector>

#include "app/report/report_streams.hpp"
#include "app/report/report_units.hpp"
#include "io/fields/vtu.hpp"

namespace perilink {

/// A number per particle that a report shows.
struct ReportField {
  std::string name;   ///< "largest principal strain"
  std::string array;  ///< point data that it comes from
  int component = 0;  ///< of the array; -1: length of the vector; -2: von Mises stress
};

/// Returns the fields of a file: components of displacement first, then every number per particle;
/// largest and smallest of principal values, the von Mises stress, lengths of other vectors.
/// \param dim  2 or 3
std::vector<ReportField> fields_of(const VtuGrid& grid, int dim);

/// Returns the values of a field, shape (particles). Empty where the file lacks its array.
std::vector<float> values_of_field(const VtuGrid& grid, const ReportField& field);

/// Range of numbers; without any, `low` is above `high`.
struct NumberRange {
  float low = std::numeric_limits<float>::max();
  float high = std::numeric_limits<float>::lowest();

  void include(const NumberRange& other);
};

/// Returns the range of numbers.
NumberRange range_of(const std::vector<float>& numbers);

/// Returns the range of numbers without a share of the smallest and of the largest [-].
NumberRange inner_range(std::vector<float> numbers, double share);

}  // namespace perilink
