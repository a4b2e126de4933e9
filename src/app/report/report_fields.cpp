#include "app/report/report_fields.hpp"

#include <algorithm>
#include <cmath>

#include "app/plot/plot_body.hpp"

namespace perilink {
namespace {

constexpr int vector_length = -1, mises = -2;

/// Whether an array describes the mesh, supports and loads, or a direction, which no colour shows.
bool is_left_out(const VtuArray& array) {
  const bool is_condition = array.name == "held" || array.name == "applied_force" ||
                            array.name == "prescribed_displacement";
  return is_condition || array.name == "kind" || array.name == "volume" ||
         array.name == "displacement" || array.name.ends_with("_direction");
}

}  // namespace

std::vector<ReportField> fields_of(const VtuGrid& grid, int dim) {
  std::vector<ReportField> fields;
  for (int axis = 0; axis < dim; ++axis) {
    fields.push_back({std::string("displacement ") + "xyz"[axis], "displacement", axis});
  }
  for (const VtuArray& array : grid.point_data) {
    if (is_left_out(array)) continue;
    const std::string words = in_words(array.name);
    if (array.components == 1) {
      fields.push_back({array.name == "region" ? "material" : words, array.name, 0});
    } else if (array.name.starts_with("principal_") && array.components == 3) {
      const int last = array.name == "principal_stress" && dim == 2 ? 1 : dim - 1;
      fields.push_back({"largest " + words, array.name, 0});
      fields.push_back({"smallest " + words, array.name, last});
    } else if (array.name == "stress" && array.components == 6) {
      fields.push_back({"von Mises stress", array.name, mises});
    } else if (array.components == 3) {
      fields.push_back({words, array.name, vector_length});
    }
  }
  return fields;
}

std::vector<float> values_of_field(const VtuGrid& grid, const ReportField& field) {
  const VtuArray* array = grid.find_point_data(field.array);
  if (array == nullptr || array->components <= field.component) return {};
  const auto width = static_cast<std::size_t>(array->components);
  if ((field.component == mises && width != 6) || (field.component == vector_length && width != 3))
    return {};
  std::vector<float> values(array->values.size() / width);
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double* at = array->values.data() + width * i;
    const double value = field.component == mises           ? von_mises(at)
                         : field.component == vector_length ? std::hypot(at[0], at[1], at[2])
                                                            : at[field.component];
    // Larger numbers have no single precision.
    values[i] = static_cast<float>(std::clamp(value, -1e37, 1e37));
  }
  return values;
}

void NumberRange::include(const NumberRange& other) {
  low = std::min(low, other.low);
  high = std::max(high, other.high);
}

NumberRange range_of(const std::vector<float>& numbers) {
  if (numbers.empty()) return {};
  const auto [low, high] = std::ranges::minmax_element(numbers);
  return {*low, *high};
}

NumberRange inner_range(std::vector<float> numbers, double share) {
  if (numbers.empty()) return {};
  const auto count = static_cast<std::ptrdiff_t>(numbers.size());
  const auto left_out = static_cast<std::ptrdiff_t>(share * static_cast<double>(count));
  const auto low = numbers.begin() + left_out, high = numbers.end() - 1 - left_out;
  std::ranges::nth_element(numbers, low);
  const float least = *low;
  std::ranges::nth_element(numbers, high);
  return {least, *high};
}

}  // namespace perilink
