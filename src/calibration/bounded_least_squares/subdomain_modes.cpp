#include "calibration/bounded_least_squares/subdomain_modes.hpp"

namespace perilink {

SubdomainModes::SubdomainModes(std::size_t count, std::span<const double> fields)
    : count_(count),
      rows_(count == 0 ? 0 : fields.size() / count),
      width_((count + lanes - 1) / lanes * lanes),
      values_(rows_ * width_, 0.0F) {
  for (std::size_t f = 0; f < count; ++f) {
    for (std::size_t row = 0; row < rows_; ++row) {
      values_[row * width_ + f] = static_cast<float>(fields[f * rows_ + row]);
    }
  }
}

std::vector<double> SubdomainModes::values() const {
  std::vector<double> values;
  values.reserve(rows_ * count_);
  for (std::size_t row = 0; row < rows_; ++row) {
    const float* fields = values_.data() + row * width_;
    values.insert(values.end(), fields, fields + count_);
  }
  return values;
}

void SubdomainModes::add_sums(std::size_t first, std::span<const double> values,
                              double* sums) const {
  const std::size_t count = count_;
  for (std::size_t row = 0; row < values.size(); ++row) {
    const float* fields = values_.data() + (first + row) * width_;
    const double value = values[row];
#pragma omp simd
    for (std::size_t f = 0; f < count; ++f) sums[f] += static_cast<double>(fields[f]) * value;
  }
}

void SubdomainModes::add_fields(std::span<const double> shares, double* values) const {
  for (std::size_t row = 0; row < rows_; ++row) {
    const float* fields = values_.data() + row * width_;
    double sum = 0.0;
#pragma omp simd reduction(+ : sum)
    for (std::size_t f = 0; f < shares.size(); ++f) {
      sum += static_cast<double>(fields[f]) * shares[f];
    }
    values[row] += sum;
  }
}

}  // namespace perilink
