#include "analysis/quasistatic/events/dozing_columns.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <utility>

namespace perilink {
namespace {

constexpr double unknown = std::numeric_limits<double>::infinity();

/// Round-off of displacements that are added up in another order.
constexpr double round_off = 1e-6;

/// Blocks of elements that threads share when columns are measured.
constexpr std::size_t blocks_for_threads = 2000;

}  // namespace

DozingColumns::DozingColumns(const DeferredMotion& motion, Index blocks, int dim,
                             LargestOfColumns largest_of, EndsOf ends_of)
    : motion_(&motion),
      dim_(dim),
      largest_of_(std::move(largest_of)),
      ends_of_(std::move(ends_of)),
      bounds_(static_cast<std::size_t>(blocks), unknown),
      restless_(static_cast<std::size_t>(blocks), false),
      seen_(motion.displacement->size() / static_cast<std::size_t>(dim), -1) {}

void DozingColumns::follow() {
  if (restarts_ != motion_->restarts || renewals_ != motion_->renewals) {
    std::ranges::fill(bounds_, unknown);
    counted_ = motion_->moved;
  }
  if (renewals_ != motion_->renewals) ratios_.clear();
  restarts_ = motion_->restarts;
  renewals_ = motion_->renewals;
  measure_columns();
  const std::vector<double>& moved = motion_->moved;
  counted_.resize(moved.size(), 0.0);
  for (std::size_t k = 0; k < moved.size(); ++k) {
    const double step = (1.0 + round_off) * (moved[k] - counted_[k]);
    if (step == 0.0) continue;
    const double* ratio = ratios_[k / block_width].data() + k % block_width * bounds_.size();
    double* bound = bounds_.data();
    for (std::size_t b = 0; b < bounds_.size(); ++b) bound[b] += step * ratio[b];
  }
  counted_ = moved;
}

void DozingColumns::measure_columns() {
  while (ratios_.size() < motion_->blocks->size()) {
    const BlockVector<double>& columns = (*motion_->blocks)[ratios_.size()];
    std::vector<double>& ratios = ratios_.emplace_back(bounds_.size() * block_width);
#pragma omp parallel for schedule(static) if (bounds_.size() > blocks_for_threads)
    for (std::size_t b = 0; b < bounds_.size(); ++b) {
      const std::array<double, block_width> largest =
          largest_of_(static_cast<Index>(b), columns.data());
      for (std::size_t c = 0; c < block_width; ++c) ratios[c * bounds_.size() + b] = largest[c];
    }
  }
}

Index DozingColumns::likeliest() const {
  if (bounds_.empty()) return no_index;
  return static_cast<Index>(std::ranges::max_element(bounds_) - bounds_.begin());
}

void DozingColumns::look(Index block) {
  if (!motion_->is_behind()) return;
  const auto dim = static_cast<std::size_t>(dim_);
  ends_of_(block, [&](std::size_t slot) {
    if (std::exchange(seen_[slot / dim], motion_->changes) == motion_->changes) return;
    const std::array<double, 3> steps = motion_->steps_at(slot, dim);
    for (std::size_t a = 0; a < dim; ++a) {
      const Index unknown_here = motion_->unknowns->number[slot + a];
      if (unknown_here == no_index) continue;
      (*motion_->displacement)[slot + a] = (*motion_->solution)[unknown_here] + steps[a];
    }
  });
}

void DozingColumns::remember(Index block, double largest) {
  const auto b = static_cast<std::size_t>(block);
  if (!restless_[b]) bounds_[b] = largest;
}

void DozingColumns::wake(Index block, bool is_lower) {
  if (!any()) return;
  const auto b = static_cast<std::size_t>(block);
  bounds_[b] = unknown;
  if (is_lower) restless_[b] = true;
}

}  // namespace perilink
