#include "analysis/quasistatic/subdomains/subdomain_factor.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>
#include <stdexcept>
#include <utility>

#include "solver/blocks/block_gradients.hpp"

namespace perilink {
namespace {

constexpr std::size_t fewest_blocks = 64 / block_width;

/// Iterations of a block over the first block's, above which the subdomains are made anew.
constexpr double slower = 1.3;

/// Pivots below which the cache is cleared.
constexpr double small_pivot = 0.1;

/// Error of columns over the error of solutions. An event moves the body little, and every check
/// removes the error that is left.
constexpr double coarser = 100.0;

/// Memory of the cache, except for the fewest blocks [bytes].
constexpr double most_bytes = 4e9;

/// Age of evicted columns, above the number of calls in a run.
constexpr int let_go_after = 1 << 30;

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

SubdomainFactor::SubdomainFactor(const Network& network, const SubdomainSolverOptions& options)
    : network_(network), options_(options) {
  options_.blocks = true;
}

void SubdomainFactor::begin(const Unknowns& unknowns, Secants secants,
                            const std::vector<double>& ground) {
  unknowns_ = &unknowns;
  secants_ = secants;
  ground_ = &ground;
  slot_of_ = unknowns.slots();
  ++begun_;
  expected_.clear();
  place_of_.assign(static_cast<std::size_t>(unknowns.count), no_index);
  window_.clear();
  forget();
  make_solver();
}

/// Makes the subdomains of the present body, split along its cracks.
void SubdomainFactor::make_solver() {
  solver_.reset();  // frees memory first
  solver_ = std::make_unique<SubdomainSolver>(network_, *unknowns_, secants_, options_, ground_);
  first_iterations_ = 0;
}

void SubdomainFactor::factorize(const SparseMatrix& /*matrix*/, std::span<const Index> /*groups*/) {
  throw std::logic_error("there is no matrix to factorise, see begin()");
}

void SubdomainFactor::refactorize(const SparseMatrix& /*matrix*/) {
  throw std::logic_error("there is no matrix to factorise, see begin()");
}

void SubdomainFactor::solve(std::span<const double> rhs, std::span<double> solution) {
  solver_->solve(rhs, solution);
}

void SubdomainFactor::correct(std::vector<double>& residual, double energy) {
  energy > 0.0 ? solver_->correct(residual, residual, energy) : solver_->solve(residual, residual);
}

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

void SubdomainFactor::forget() {
  std::ranges::fill(place_of_, no_index);
  span_.clear();
  window_.clear();
  used_.clear();
  blocks_.clear();
  shares_.resize(0, 0);
  compliance_.resize(0, 0);
}

void SubdomainFactor::let_go(std::span<const SparseVector> x) {
  for (std::size_t place = 0; place < window_.size(); ++place) {
    const auto is_here = [&](const SparseVector& gone) {
      return share_of(gone, window_[place]) != 0.0;
    };
    if (std::ranges::any_of(x, is_here)) used_[place] = now_ - let_go_after;
  }
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
  used_.push_back(used);
}

std::vector<SparseVector> SubdomainFactor::missing_of(std::span<const SparseVector> x) const {
  std::vector<SparseVector> missing;
  std::ranges::copy_if(x, std::back_inserter(missing),
                       [&](const SparseVector& column) { return !holds(column); });
  return missing;
}

/// Loads missing and expected vectors into the cache.
void SubdomainFactor::hold(std::span<const SparseVector> x, Correction* correction) {
  const std::vector<SparseVector> missing = missing_of(x);
  if (missing.empty()) return;
  ++now_;
  for (const SparseVector& column : x) {
    for (const Index unknown : column.rows) {
      if (place_of_[unknown] != no_index) used_[place_of_[unknown]] = now_;
    }
  }
  const std::size_t reserved = correction != nullptr ? 1 : 0;
  std::vector<SparseVector> chosen = choose(missing, reserved);
  if ((blocks_.size() + blocks_of(chosen.size())) * block_width >
      columns_of_window(unknowns_->number.size(), options_)) {
    keep_latest();
    chosen = choose(missing_of(x), reserved);  // some may have been evicted
  }
  const std::span<const SparseVector> all(chosen);
  for (std::size_t begin = 0; begin < all.size(); begin += block_width) {
    const std::size_t count = std::min<std::size_t>(block_width, all.size() - begin);
    take_in(all.subspan(begin, count), count < block_width ? correction : nullptr);
  }
}

bool SubdomainFactor::hold_and_correct(std::span<const SparseVector> x,
                                       std::vector<double>& residual, double energy) {
  Correction correction{residual, energy};
  hold(x, &correction);
  return correction.is_done;
}

/// Returns missing and, where blocks have room, expected vectors. For elements that carry moments
/// it returns unknowns, as combinations of their vectors are requested.
/// \param reserved  columns of the last block to leave free if possible
std::vector<SparseVector> SubdomainFactor::choose(const std::vector<SparseVector>& missing,
                                                  std::size_t reserved) const {
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
  const std::size_t room =
      std::max(chosen.size(), blocks_of(chosen.size()) * block_width - reserved);
  for (const SparseVector& x : expected_) {
    if (chosen.size() < room) list_what_it_needs(x);
  }
  if (chosen.size() > room) chosen.resize(room);
  return chosen;
}

/// Solves for columns and appends them to the cache.
void SubdomainFactor::take_in(std::span<const SparseVector> x, Correction* correction) {
  const auto before = static_cast<Eigen::Index>(window_.size());
  const auto size = before + static_cast<Eigen::Index>(x.size());
  const double enough = coarser * options_.tolerance;
  double size_of_last = 0.0;
  if (correction != nullptr && correction->energy > 0.0) {
    const double wanted = options_.tolerance * SubdomainSolver::finer;
    size_of_last = correction->energy * (wanted / enough) * (wanted / enough);
  }
  fill_right_sides(x, correction);
  blocks_.emplace_back(right_.size());
  const int iterations =
      solver_->solve_block(right_, blocks_.back(), enough, size_of_last).iterations;
  if (first_iterations_ == 0) first_iterations_ = iterations;
  if (iterations > slower * first_iterations_) make_solver();
  columns_solved_ += static_cast<Index>(x.size());
  for (std::size_t k = 0; correction != nullptr && k < slot_of_.size(); ++k) {
    correction->residual[k] =
        std::exchange(blocks_.back()[slot_of_[k] * block_width + block_width - 1], 0.0);
    correction->is_done = true;
  }
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
  mirror_compliance(before);
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

/// Completes the compliance of the columns from `before` on by symmetry.
void SubdomainFactor::mirror_compliance(Eigen::Index before) {
  const Eigen::Index count = compliance_.cols() - before;
  compliance_.bottomLeftCorner(count, before) =
      compliance_.topRightCorner(before, count).transpose();
  const Eigen::MatrixXd own = compliance_.bottomRightCorner(count, count);
  compliance_.bottomRightCorner(count, count) = 0.5 * (own + own.transpose());
}

void SubdomainFactor::fill_right_sides(std::span<const SparseVector> x,
                                       const Correction* correction) {
  right_.assign(unknowns_->number.size() * block_width, 0.0);
  for (std::size_t c = 0; c < x.size(); ++c) {
    for (int k = 0; k < x[c].size(); ++k) {
      right_[slot_of_[x[c].rows[k]] * block_width + c] = x[c].values[k];
    }
  }
  for (std::size_t k = 0; correction != nullptr && k < slot_of_.size(); ++k) {
    right_[slot_of_[k] * block_width + block_width - 1] = correction->residual[k];
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

/// Returns the blocks times weights, per unknown.
std::vector<double> SubdomainFactor::motion_of(const Eigen::VectorXd& weights) const {
  std::vector<double> motion(unknowns_->number.size(), 0.0);
  for (std::size_t b = 0; b < blocks_.size(); ++b) {
    const std::span<const double> own(weights.data() + b * block_width, block_width);
    if (std::ranges::all_of(own, [](double weight) { return weight == 0.0; })) continue;
    add_combination(blocks_[b], own, motion);
  }
  std::vector<double> result(slot_of_.size());
  for (std::size_t k = 0; k < result.size(); ++k) result[k] = motion[slot_of_[k]];
  return result;
}

std::vector<double> SubdomainFactor::columns(std::span<const SparseVector> x) {
  hold(x);
  std::vector<double> result;
  for (const SparseVector& column : x) {
    const std::vector<double> motion = motion_of(shares_ * in_window(column));
    result.insert(result.end(), motion.begin(), motion.end());
  }
  return result;
}

void SubdomainFactor::compliance(std::span<const SparseVector> x, std::span<double> result) {
  hold(x);
  std::vector<std::vector<Part>> parts;
  for (const SparseVector& column : x) parts.push_back(parts_of(column).value());
  for (std::size_t a = 0; a < x.size(); ++a) {
    for (std::size_t b = 0; b <= a; ++b) {
      double sum = 0.0;
      for (const auto& [row, first] : parts[a]) {
        for (const auto& [column, second] : parts[b]) {
          sum += first * second * compliance_(row, column);
        }
      }
      result[a * x.size() + b] = result[b * x.size() + a] = sum;
    }
  }
}

/// Changes K^-1 to K^-1 + sign (K^-1 x) (K^-1 x)' / pivot.
void SubdomainFactor::change(const Eigen::VectorXd& d, double pivot, double sign) {
  const Eigen::VectorXd h = compliance_ * d, f = shares_ * d;
  compliance_.noalias() += (sign / pivot) * h * h.transpose();
  shares_.noalias() += (sign / pivot) * f * h.transpose();
}

void SubdomainFactor::downdate(std::span<const SparseVector> x,
                               std::span<const double> load_changes, std::span<const double> pivots,
                               std::span<double> solution) {
  for (const SparseVector& column : x) {
    if (!holds(column)) throw std::logic_error("columns must be solved for before a change");
  }
  if (!solution.empty()) {
    const std::vector<double> shares = extensions(x, load_changes, solution);
    Eigen::VectorXd sum = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(window_.size()));
    for (std::size_t a = 0; a < x.size(); ++a) sum += shares[a] / pivots[a] * in_window(x[a]);
    const std::vector<double> motion = motion_of(shares_ * sum);
    for (std::size_t k = 0; k < motion.size(); ++k) solution[k] += motion[k];
  }
  for (std::size_t a = 0; a < x.size(); ++a) change(in_window(x[a]), pivots[a], 1.0);
  // Errors of columns grow in proportion to the motions.
  if (std::ranges::any_of(pivots, [](double pivot) { return pivot < small_pivot; })) forget();
}

void SubdomainFactor::follow(std::vector<double>& residual, double energy) {
  constexpr double many_more = 1.5;
  if (!window_.empty()) forget();
  const int before = solver_->iterations();
  correct(residual, energy);
  const int iterations = solver_->iterations() - before;
  all_iterations_ += iterations;
  if (following_iterations_ == 0) following_iterations_ = iterations;
  if (iterations <= many_more * following_iterations_) return;
  make_solver();
  following_iterations_ = 0;
  ++begun_;
}

void SubdomainFactor::update(const SparseVector& x) {
  double removed = 0.0;
  compliance({&x, 1}, {&removed, 1});
  change(in_window(x), 1.0 + removed, -1.0);
}

FactorStatistics SubdomainFactor::statistics() const {
  FactorStatistics result;
  result.size = static_cast<Index>(slot_of_.size());
  result.entries = static_cast<double>(slot_of_.size()) * static_cast<double>(window_.size());
  result.bytes = 8.0 * result.entries;
  result.event_bytes = result.bytes;
  // A restart costs two solves: about a hundred products of ten operations per bond.
  result.flops = 1000.0 * static_cast<double>(network_.num_elements());
  result.factorizations = begun_;
  result.iterations = all_iterations_;
  result.ranks = solver_ ? solver_->num_ranks() : 1;
  result.subdomains = solver_ ? solver_->num_subdomains() : 0;
  return result;
}

}  // namespace perilink
