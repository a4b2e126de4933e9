#include "calibration/bounded_least_squares/packed_product.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/lanes.hpp"
#include "discretization/point_boxes.hpp"

namespace perilink {
namespace {

/// Least number of points for threads, and the number of parts.
constexpr Index points_for_parts = 8000;
constexpr std::size_t most_parts = 8;
/// Points per block, whose neighbours stay in the first cache.
constexpr Index points_of_box = 96;

using Doubles = Lanes<double, 4>;
using InMemory = LanesInMemory<double, 4>;

/// The twelve numbers of a point.
struct Row {
  explicit Row(const double* numbers) {
    for (int k = 0; k < 3; ++k) parts[k] = reinterpret_cast<const InMemory*>(numbers)[k];
  }
  explicit Row(const float* numbers) {
    for (int k = 0; k < 3; ++k) parts[k] = widen(numbers + 4 * k);
  }
  void store(double* numbers) const {
    for (int k = 0; k < 3; ++k) reinterpret_cast<InMemory*>(numbers)[k] = parts[k];
  }

  Doubles parts[3];
};

/// Forces are opposite at the two ends, energies have equal signs.
constexpr Doubles all_odd = {-1.0, -1.0, -1.0, -1.0};
constexpr Doubles signs[3] = {all_odd, all_odd, {-1.0, -1.0, 1.0, 0.0}};

/// Returns a.(s y) of both ends, times the active-set weight.
inline double pull(const Row& a, const Row& near, const Row& far, float active_weight) {
  Doubles sum = a.parts[0] * (near.parts[0] - far.parts[0]);
  sum += a.parts[1] * (near.parts[1] - far.parts[1]);
  sum += a.parts[2] * (near.parts[2] + signs[2] * far.parts[2]);
  return add_up(sum) * static_cast<double>(active_weight);
}

}  // namespace

PackedProduct::PackedProduct(const PointEquations& equations)
    : equations_(equations), scale_(equations.scale) {
  double largest = 0.0;
  for (const double a : equations.coefficients) largest = std::max(largest, std::abs(a));
  if (largest > 0.0) unit_ = std::exp2(std::ilogb(largest));
  for (double& scale : scale_) scale *= unit_;
  order_points();
  pack();
  values_.assign(point_.size() * width, 0.0);
  sums_.assign(point_.size() * width, 0.0);
}

void PackedProduct::order_points() {
  const Index count = equations_.num_points();
  const auto boxes = split_into_boxes(equations_.positions, equations_.dim, points_of_box);
  const std::size_t parts = count < points_for_parts ? 1 : most_parts;
  place_.resize(static_cast<std::size_t>(count));
  for (const std::vector<Index>& box : boxes) {
    for (const Index p : box) {
      place_[p] = static_cast<Index>(point_.size());
      point_.push_back(p);
    }
    const std::size_t full = static_cast<std::size_t>(count) * (part_end_.size() + 1) / parts;
    if (point_.size() >= full) part_end_.push_back(point_.size());
  }
}

/// Calls visit(row, other position, whether the row is of the second end).
template <class Visit>
void PackedProduct::for_each_row(Index variable, Visit visit) const {
  const Index first = place_[equations_.first[variable]];
  const Index second = place_[equations_.second[variable]];
  const Index from = std::min(first, second), to = std::max(first, second);
  const auto part_of = [&](Index place) {
    return std::ranges::upper_bound(part_end_, static_cast<std::size_t>(place));
  };
  const std::size_t row = 2 * static_cast<std::size_t>(from);
  if (part_of(from) == part_of(to)) return visit(row, to, from != first);
  visit(row + 1, to, from != first);
  visit(2 * static_cast<std::size_t>(to) + 1, from, from == first);
}

void PackedProduct::pack() {
  begin_.assign(2 * point_.size() + 2, 0);
  for (Index v = 0; v < equations_.num_variables(); ++v) {
    for_each_row(v, [&](std::size_t row, Index, bool) { ++begin_[row + 2]; });
  }
  for (std::size_t k = 2; k < begin_.size(); ++k) begin_[k] += begin_[k - 1];
  coefficients_.resize(begin_.back() * width);
  other_.resize(begin_.back());
  variable_.resize(begin_.back());
  const std::size_t rows = static_cast<std::size_t>(equations_.rows);
  for (Index v = 0; v < equations_.num_variables(); ++v) {
    const double* a = equations_.coefficients.data() + static_cast<std::size_t>(v) * rows;
    for_each_row(v, [&](std::size_t row, Index other, bool second) {
      const std::size_t entry = begin_[row + 1]++;
      float* packed = coefficients_.data() + entry * width;
      for (std::size_t r = 0; r < odd; ++r)
        packed[r] = static_cast<float>((second ? -a[r] : a[r]) / unit_);
      const bool paired = rows > odd && v < equations_.one_ended;
      packed[odd] = paired ? static_cast<float>(a[odd] / unit_) : 0.0F;
      packed[weight] = 1.0F;
      other_[entry] = other;
      variable_[entry] = v;
    });
  }
  begin_.pop_back();
}

void PackedProduct::set(std::span<const double> active_weight) {
  for (std::size_t entry = 0; entry < variable_.size(); ++entry) {
    coefficients_[entry * width + weight] = static_cast<float>(active_weight[variable_[entry]]);
  }
}

/// Computes the sums at the positions of a part.
void PackedProduct::multiply(std::size_t part) {
  const std::size_t first = part == 0 ? 0 : part_end_[part - 1], last = part_end_[part];
  std::fill(sums_.begin() + static_cast<std::ptrdiff_t>(first * width),
            sums_.begin() + static_cast<std::ptrdiff_t>(last * width), 0.0);
  const double* values = values_.data();
  for (std::size_t place = first; place < last; ++place) {
    const Row near(values + place * width);
    Row sum(sums_.data() + place * width);
    for (std::size_t entry = begin_[2 * place]; entry < begin_[2 * place + 1]; ++entry) {
      const float* packed = coefficients_.data() + entry * width;
      const std::size_t other = static_cast<std::size_t>(other_[entry]) * width;
      const Row a(packed);
      const double force = pull(a, near, Row(values + other), packed[weight]);
      Row far(sums_.data() + other);
      for (int k = 0; k < 3; ++k) {
        const Doubles term = a.parts[k] * force;
        sum.parts[k] += term;
        far.parts[k] += signs[k] * term;
      }
      far.store(sums_.data() + other);
    }
    for (std::size_t entry = begin_[2 * place + 1]; entry < begin_[2 * place + 2]; ++entry) {
      const float* packed = coefficients_.data() + entry * width;
      const std::size_t other = static_cast<std::size_t>(other_[entry]) * width;
      const Row a(packed);
      const double force = pull(a, near, Row(values + other), packed[weight]);
      for (int k = 0; k < 3; ++k) sum.parts[k] += a.parts[k] * force;
    }
    sum.store(sums_.data() + place * width);
  }
}

void PackedProduct::apply(std::span<const double> y, std::span<double> result) {
  const std::size_t rows = static_cast<std::size_t>(equations_.rows);
  const bool grouped = rows > odd;
  const double* scale = scale_.data();
#pragma omp parallel for schedule(static) if (part_end_.size() > 1)
  for (std::size_t place = 0; place < point_.size(); ++place) {
    const std::size_t first = static_cast<std::size_t>(point_[place]) * rows;
    double* values = values_.data() + place * width;
    for (std::size_t r = 0; r < odd; ++r) values[r] = y[first + r] * scale[first + r];
    if (!grouped) continue;
    const std::size_t last = (equations_.group[point_[place]] + 1) * rows - 1;
    values[odd] = y[last] * scale[last];
  }
#pragma omp parallel for schedule(dynamic) if (part_end_.size() > 1)
  for (std::size_t part = 0; part < part_end_.size(); ++part) multiply(part);
#pragma omp parallel for schedule(static) if (part_end_.size() > 1)
  for (std::size_t place = 0; place < point_.size(); ++place) {
    const std::size_t first = static_cast<std::size_t>(point_[place]) * rows;
    const double* sums = sums_.data() + place * width;
    for (std::size_t r = 0; r < odd; ++r) result[first + r] = sums[r] * scale[first + r];
    if (grouped) result[first + odd] = 0.0;
  }
  for (std::size_t place = 0; grouped && place < point_.size(); ++place) {
    const std::size_t last = (equations_.group[point_[place]] + 1) * rows - 1;
    result[last] += sums_[place * width + odd] * scale[last];
  }
}

/// Adds the products of odd coefficients, which do not depend on the signs of the ends.
/// \param sums  shape (places, odd, width)
void PackedProduct::add_blocks(std::size_t part, double* sums) const {
  const std::size_t first = part == 0 ? 0 : part_end_[part - 1], last = part_end_[part];
  for (std::size_t place = first; place < last; ++place) {
    for (std::size_t entry = begin_[2 * place]; entry < begin_[2 * place + 2]; ++entry) {
      const float* packed = coefficients_.data() + entry * width;
      if (packed[weight] == 0.0F) continue;
      const Row a(packed);
      double* near = sums + place * odd * width;
      double* far = sums + static_cast<std::size_t>(other_[entry]) * odd * width;
      const bool both = entry < begin_[2 * place + 1];
      for (std::size_t r = 0; r < odd; ++r) {
        const double factor = static_cast<double>(packed[r]) * static_cast<double>(packed[weight]);
        Row own(near + r * width);
        for (int k = 0; k < 3; ++k) own.parts[k] += a.parts[k] * factor;
        own.store(near + r * width);
        if (!both) continue;
        Row others(far + r * width);
        for (int k = 0; k < 3; ++k) others.parts[k] += a.parts[k] * factor;
        others.store(far + r * width);
      }
    }
  }
}

/// Adds the row of the group to the blocks of its points.
void PackedProduct::add_last_rows(std::vector<double>& blocks) const {
  const std::size_t rows = static_cast<std::size_t>(equations_.rows);
  const std::vector<Index>& group = equations_.group;
  for (std::size_t place = 0; place < point_.size(); ++place) {
    for (std::size_t entry = begin_[2 * place]; entry < begin_[2 * place + 2]; ++entry) {
      const float* packed = coefficients_.data() + entry * width;
      if (packed[odd] == 0.0F) continue;
      const bool both = entry < begin_[2 * place + 1];
      const Index near = point_[place], far = point_[other_[entry]];
      const double last = static_cast<double>(packed[odd]) * static_cast<double>(packed[weight]);
      const auto add = [&](Index point, double times) {
        double* row = blocks.data() + ((point + 1) * rows - 1) * rows;
        row[odd] += times * times * static_cast<double>(packed[odd]) * last;
        for (const auto& [end, sign] : {std::pair(near, 1.0), std::pair(far, -1.0)}) {
          if (end != point) continue;
          for (std::size_t r = 0; r < odd; ++r) {
            row[r] += sign * times * static_cast<double>(packed[r]) * last;
          }
        }
      };
      if (group[near] == group[far]) {
        if (both || near < far) add(group[near], 2.0);
        continue;
      }
      add(group[near], 1.0);
      if (both) add(group[far], 1.0);
    }
  }
}

std::vector<double> PackedProduct::blocks() const {
  const std::size_t rows = static_cast<std::size_t>(equations_.rows), points = point_.size();
  BlockVector<double> sums(points * odd * width, 0.0);
#pragma omp parallel for schedule(dynamic) if (part_end_.size() > 1)
  for (std::size_t part = 0; part < part_end_.size(); ++part) add_blocks(part, sums.data());
  std::vector<double> blocks(points * rows * rows, 0.0);
  if (rows > odd) add_last_rows(blocks);
  for (std::size_t p = 0; p < points; ++p) {
    const double* own = sums.data() + static_cast<std::size_t>(place_[p]) * odd * width;
    const double* scale = scale_.data() + p * rows;
    double* block = blocks.data() + p * rows * rows;
    for (std::size_t r = 0; r < odd; ++r) {
      for (std::size_t c = 0; c < odd; ++c) {
        block[r * rows + c] = own[r * width + c] * scale[r] * scale[c];
      }
    }
    for (std::size_t c = 0; rows > odd && c < rows; ++c) {  // the last row and column
      const double value = block[odd * rows + c] * scale[odd] * scale[c];
      block[odd * rows + c] = block[c * rows + odd] = value;
    }
  }
  return blocks;
}

}  // namespace perilink
