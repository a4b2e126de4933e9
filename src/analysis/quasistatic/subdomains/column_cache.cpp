/// \file
/// The column cache of SubdomainFactor: which columns of K^-1 it holds, loads and evicts.

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>
#include <utility>

#include "analysis/quasistatic/subdomains/subdomain_factor.hpp"
#include "solver/blocks/block_gradients.hpp"

namespace perilink {
namespace {

constexpr std::size_t fewest_blocks = 64 / block_width;

/// Iterations of a block over the first block's, above which the subdomains are made anew.
constexpr double slower = 1.3;

/// Error of columns over the error of solutions. An event moves the body little, and every check
/// removes the error that is left.
constexpr double coarser = 100.0;

/// Memory of the cache, except for the fewest blocks [bytes].
constexpr double most_bytes = 4e9;

std::size_t blocks_of(std::size_t columns) { return (columns + block_width - 1) / block_width; }

/// Returns s if x = s held, else 0.
double share_of(const SparseVector& x, const SparseVector& held) {
  constexpr double same = 1e-14;
  if (x.rows != held.rows) return 0.0;
  const auto largest =
      std::ranges::max_element(held.values, {}, [](double value) { return std::abs(value); });
  const double at = x.values[static_cast<std::size_t>(largest - held.values.begin())];
  const double share = at / *largest;
  for (int k = 0; k < x.size(); ++k) {
    if (!(std::abs(x.values[k] - share * held.values[k]) <= same * std::abs(at))) return 0.0;
  }
  return share;
}

}  // namespace

/// Returns the vector as a combination of cached vectors, if it is one.
auto SubdomainFactor::parts_of(const SparseVector& x) const -> std::optional<std::vector<Part>> {
  std::vector<Part> parts;
  for (int k = 0; k < x.size(); ++k) {
    const Index place = place_of_[x.rows[k]];
    if (place == no_index) break;
    parts.push_back({place, x.values[k] / window_[place].values[0]});
  }
  if (parts.size() == x.rows.size()) return parts;
  for (std::size_t place = 0; place < window_.size(); ++place) {
    const double share = share_of(x, window_[place]);
    if (share != 0.0) return std::vector<Part>{{static_cast<Index>(place), share}};
  }
  return span_.parts_of(x);
}

void SubdomainFactor::clear() {
  std::ranges::fill(place_of_, no_index);
  span_.clear();
  window_.clear();
  used_.clear();
  blocks_.clear();
  shares_.resize(0, 0);
  compliance_.resize(0, 0);
}

/// Frees half of the blocks. The columns used last are stored with their present values.
void SubdomainFactor::keep_latest() {
  const std::size_t kept = std::min(blocks_.size() / 2 * block_width, window_.size());
  std::vector<Eigen::Index> places(window_.size());
  std::iota(places.begin(), places.end(), 0);
  std::stable_sort(places.begin(), places.end(),
                   [&](Eigen::Index a, Eigen::Index b) { return used_[a] > used_[b]; });
  places.resize(kept);
  const std::size_t columns = blocks_of(kept) * block_width;
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> shares =
      Eigen::MatrixXd::Zero(shares_.rows(), static_cast<Eigen::Index>(columns));
  shares.leftCols(static_cast<Eigen::Index>(kept)) = shares_(Eigen::all, places);
  recombine(blocks_, {shares.data(), static_cast<std::size_t>(shares.size())});
  compliance_ = Eigen::MatrixXd(compliance_(places, places));
  shares_ = Eigen::MatrixXd::Identity(static_cast<Eigen::Index>(columns),
                                      static_cast<Eigen::Index>(kept));
  const std::vector<SparseVector> window = std::move(window_);
  const std::vector<int> used = std::move(used_);
  window_.clear();
  used_.clear();
  span_.clear();
  std::ranges::fill(place_of_, no_index);
  for (const Eigen::Index place : places) put_in_window(window[place], used[place]);
}

std::size_t columns_of_window(std::size_t components, const SubdomainSolverOptions& options) {
  const double bytes = 8.0 * static_cast<double>(components) * block_width;
  const auto wanted = static_cast<std::size_t>(options.window);
  const auto room = static_cast<std::size_t>(most_bytes / bytes);
  return block_width * std::max(fewest_blocks, std::min(room, blocks_of(wanted)));
}

void SubdomainFactor::put_in_window(const SparseVector& x, int used) {
  const auto place = static_cast<Index>(window_.size());
  if (x.size() == 1) place_of_[x.rows[0]] = place;
  span_.add(x, place);
  window_.push_back(x);
  most_columns_ = std::max(most_columns_, window_.size());
  used_.push_back(used);
}

std::vector<SparseVector> SubdomainFactor::missing_of(std::span<const SparseVector> x) const {
  std::vector<SparseVector> missing;
  std::ranges::copy_if(x, std::back_inserter(missing),
                       [&](const SparseVector& column) { return !holds(column); });
  return missing;
}

/// Loads missing and expected vectors into the cache.
void SubdomainFactor::hold(std::span<const SparseVector> x) {
  const std::vector<SparseVector> missing = missing_of(x);
  if (missing.empty()) return;
  ++now_;
  for (const SparseVector& column : x) {
    for (const Index unknown : column.rows) {
      if (place_of_[unknown] != no_index) used_[place_of_[unknown]] = now_;
    }
  }
  std::vector<SparseVector> chosen = choose(missing);
  if ((blocks_.size() + blocks_of(chosen.size())) * block_width >
      columns_of_window(unknowns_->number.size(), options_)) {
    keep_latest();
    chosen = choose(missing_of(x));  // some may have been evicted
  }
  const std::span<const SparseVector> all(chosen);
  for (std::size_t begin = 0; begin < all.size(); begin += block_width) {
    take_in(all.subspan(begin, std::min<std::size_t>(block_width, all.size() - begin)));
  }
}

/// Returns missing and, where blocks have room, expected vectors. For elements that carry moments
/// it returns unknowns, as combinations of their vectors are requested.
std::vector<SparseVector> SubdomainFactor::choose(const std::vector<SparseVector>& missing) const {
  std::vector<SparseVector> chosen;
  VectorSpan span = span_;
  const auto list = [&](const SparseVector& x) {
    const auto is_same = [&](const SparseVector& other) { return share_of(x, other) != 0.0; };
    if (holds(x) || std::ranges::any_of(chosen, is_same) || span.parts_of(x)) return;
    span.add(x, static_cast<Index>(window_.size() + chosen.size()));
    chosen.push_back(x);
  };
  const auto list_what_it_needs = [&](const SparseVector& x) {
    if (!network_.carries_moments()) return list(x);
    for (const Index unknown : x.rows) list({{unknown}, {1.0}});
  };
  std::ranges::for_each(missing, list_what_it_needs);
  const std::size_t room = blocks_of(chosen.size()) * block_width;
  for (const SparseVector& x : expected_) {
    if (chosen.size() < room) list_what_it_needs(x);
  }
  if (chosen.size() > room) chosen.resize(room);
  return chosen;
}

/// Solves for columns and appends them to the cache.
void SubdomainFactor::take_in(std::span<const SparseVector> x) {
  const auto before = static_cast<Eigen::Index>(window_.size());
  const auto size = before + static_cast<Eigen::Index>(x.size());
  const double enough = coarser * options_.tolerance;
  fill_right_sides(x);
  blocks_.emplace_back(right_.size());
  const int iterations = solver().solve_block(right_, blocks_.back(), enough).iterations;
  if (first_iterations_ == 0) first_iterations_ = iterations;
  if (iterations > slower * first_iterations_) {
    solver_.reset();  // frees memory first
    solver();
  }
  columns_solved_ += static_cast<Index>(x.size());
  for (const SparseVector& column : x) put_in_window(column, now_);

  // Positions in the cache skip unused columns of a block, which stay zero.
  const auto first_column = static_cast<Eigen::Index>((blocks_.size() - 1) * block_width);
  Eigen::MatrixXd shares = Eigen::MatrixXd::Zero(first_column + block_width, size);
  shares.topLeftCorner(shares_.rows(), before) = shares_;
  shares.block(first_column, before, size - before, size - before).setIdentity();
  shares_ = std::move(shares);
  compliance_.conservativeResize(size, size);
  compliance_.rightCols(size - before) =
      on_columns(window_, blocks_.size() - 1).leftCols(size - before);
  // The rest of the compliance follows by symmetry.
  const Eigen::Index count = size - before;
  compliance_.bottomLeftCorner(count, before) =
      compliance_.topRightCorner(before, count).transpose();
  const Eigen::MatrixXd own = compliance_.bottomRightCorner(count, count);
  compliance_.bottomRightCorner(count, count) = 0.5 * (own + own.transpose());
}

/// Returns x'y for vectors x and the columns y of a block.
Eigen::MatrixXd SubdomainFactor::on_columns(std::span<const SparseVector> x,
                                            std::size_t block) const {
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(x.size()), block_width);
  for (Eigen::Index w = 0; w < result.rows(); ++w) {
    for (int m = 0; m < x[w].size(); ++m) {
      const double* row = blocks_[block].data() + slot_of_[x[w].rows[m]] * block_width;
      for (Eigen::Index c = 0; c < block_width; ++c) result(w, c) += x[w].values[m] * row[c];
    }
  }
  return result;
}

void SubdomainFactor::fill_right_sides(std::span<const SparseVector> x) {
  right_.assign(unknowns_->number.size() * block_width, 0.0);
  for (std::size_t c = 0; c < x.size(); ++c) {
    for (int k = 0; k < x[c].size(); ++k) {
      right_[slot_of_[x[c].rows[k]] * block_width + c] = x[c].values[k];
    }
  }
}

/// Returns the weights of cached vectors in a vector.
Eigen::VectorXd SubdomainFactor::in_window(const SparseVector& x) {
  Eigen::VectorXd d = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(window_.size()));
  ++now_;
  const std::vector<Part> parts = parts_of(x).value();
  for (const auto& [place, share] : parts) {
    d[place] += share;
    used_[place] = now_;
  }
  return d;
}

}  // namespace perilink
