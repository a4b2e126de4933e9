#include "analysis/quasistatic/boxes/box_solver.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include "assembly/block_forces.hpp"
#include "base/error.hpp"
#include "solver/factor_routes.hpp"
#include "solver/not_positive_definite.hpp"

namespace perilink {
namespace {

constexpr int most_box_iterations = 20000;

/// From which on the start of threads takes less than the work.
constexpr Index many_particles = 10'000;

/// An element holds a small part of the energy: solutions in which events are looked for are finer
/// by this.
constexpr double finer = 1e-3;

/// Particles along the edge of a box. Where the body is large, larger ones keep the coarse factor
/// small; solutions that are many pay for one that is larger.
double edge_of_box(const Network& network, const BoxSolverOptions& options) {
  const Index particles = network.particles.size();
  if (options.edge > 0) return options.edge;
  if (network.dim() == 2) return options.blocks ? 6.0 : 8.0;
  if (options.blocks && particles < 100'000) return 4.0;
  return particles < 1'000'000 ? 6.0 : 8.0;
}

Index particles_of_box(const Network& network, const BoxSolverOptions& options) {
  return static_cast<Index>(std::pow(edge_of_box(network, options), network.dim()));
}

SolverError not_there(int iterations, double error, double tolerance) {
  return SolverError(fmt::format(
      "conjugate gradients stopped after {} iterations with an error of {:.1e} where {:.0e} was "
      "asked for: parts of the body are held together by very little, or the tolerance is below "
      "what round-off allows; take solver = \"direct\"",
      iterations, error, tolerance));
}

/// By their lag (L-2) estimates leave more digits than they are asked for, and columns need some of
/// them; behind a correction of single precision they lag less, and bodies that single precision
/// cannot do need more of them.
constexpr double finer_of_trusses = 0.1;

/// Energies of right sides where every particle gives way by itself, while all others stand still.
/// \param blocks  inverse ones of the particles
BlockRow local_energies(std::span<const double> blocks, int width, std::span<const double> right) {
  BlockRow energies{};
  const double* block = blocks.data();
  const std::size_t size = static_cast<std::size_t>(width) * block_width;
  for (std::size_t begin = 0; begin < right.size(); begin += size, block += width * width) {
    for (int a = 0; a < width; ++a) {
      for (int b = 0; b < width; ++b) {
        const double* first = right.data() + begin + a * block_width;
        const double* second = right.data() + begin + b * block_width;
        const double entry = block[a * width + b];
        for (int k = 0; k < block_width; ++k) energies[k] += entry * first[k] * second[k];
      }
    }
  }
  return energies;
}

double largest_stiffness(const Network& network) {
  const auto largest = std::ranges::max_element(network.stiffness);
  return largest == network.stiffness.end() || *largest <= 0.0 ? 1.0 : *largest;
}

}  // namespace

BoxSolver::BoxSolver(const Network& network, const Unknowns& unknowns, Secants secants,
                     const BoxSolverOptions& options, const std::vector<double>* ground)
    : network_(network),
      unknowns_(unknowns),
      secants_(secants),
      options_(options),
      motions_(std::in_place, network, secants, unknowns, particles_of_box(network, options)),
      ground_(ground),
      factor_(make_factor(options.blocks ? FactorRoute::refactorize : FactorRoute::in_place, 1)),
      motion_(unknowns.number.size(), 0.0) {
  expect_nothing_carried(unknowns);
  BoxStiffness stiffness = assemble_box_stiffness(network, secants, unknowns, *motions_);
  if (!stiffness.invert_blocks(unknowns.width)) {
    throw NotPositiveDefinite("the stiffness of a particle is not positive definite");
  }
  blocks_ = std::move(stiffness.blocks);
  const int motions = motions_->num_motions();
  coarse_.resize(static_cast<std::size_t>(num_boxes()) * motions);
  std::vector<Index> groups;
  for (Index b = 0; b < num_boxes(); ++b) groups.insert(groups.end(), motions, b);
  factor_->factorize(stiffness.coarse, groups);
  if (options.ranks && can_be_shared(network, unknowns)) {
    stiffness.blocks = blocks_;
    team_ = std::make_shared<Team>(*options.ranks, network, unknowns, secants, *motions_, stiffness,
                                   ground);
  }
  if (!team_ && SingleBody::is_made_of(network)) pack();
  require_resistance();
}

void BoxSolver::pack() {
  order_.emplace(*motions_, network_.particles.size());
  packed_ = std::make_unique<PackedBonds>(network_, secants_, order_->place,
                                          largest_stiffness(network_), order_->part_end());
  packed_motion_.resize(order_->place.size() * PackedBonds::row_size(network_.dim()));
  packed_forces_.resize(packed_motion_.size());
  if (!options_.blocks) return;
  single_ = std::make_unique<SingleBody>(network_, unknowns_, *motions_, *order_, *packed_, blocks_,
                                         *factor_);
}

BoxSolver::BoxSolver(const LatticePattern& pattern, const Network& places, const Unknowns& unknowns,
                     const BoxSolverOptions& options)
    : network_(places),
      unknowns_(unknowns),
      options_(options),
      team_(std::make_shared<Team>(*options.ranks, pattern, places, unknowns,
                                   particles_of_box(places, options))) {
  require_resistance();
}

/// What moves without resistance shows under forces of any kind; the loads may not stir it. With
/// the boxes as preconditioner the smallest eigenvalue of whole bodies is 0.1 to 1, of a body held
/// by the last of its bonds 1e-3, of a mechanism below 1e-16; bonds in single precision resist a
/// mechanism a little, so that they tell nothing about small ones.
void BoxSolver::require_resistance() {
  constexpr double none = 1e-8, doubtful = 1e-4, enough = 1e-4;
  constexpr int most_steps = 2000;
  std::mt19937 random(7);  // fixed: the same verdict in every run
  std::vector<double> forces(static_cast<std::size_t>(unknowns_.count));
  for (double& force : forces) force = static_cast<double>(random() % 2) - 0.5;
  std::vector<double> motion(forces.size(), 0.0);
  GradientsReport report = search(forces, motion, enough, 0.0, most_steps);
  if (packed_ && report.softest < doubtful) {
    std::ranges::fill(motion, 0.0);
    report = search_by(&BoxSolver::multiply, forces, motion, enough, 0.0, most_steps);
  }
  iterations_ += report.iterations;
  if (report.softest > none) return;
  throw NotPositiveDefinite(
      "the stiffness matrix is singular to working precision: part of the body can move freely");
}

template <class Multiply>
GradientsReport BoxSolver::search_by(Multiply multiply, std::span<const double> right,
                                     std::span<double> solution, double enough, double scale,
                                     int most_steps, const Correction& correct) {
  return conjugate_gradients(
      [&](std::span<const double> q, std::span<double> result) {
        product_threads_.run_within([&] { (this->*multiply)(q, result); });
      },
      [&](std::span<const double> r, std::span<double> z) {
        inverse_threads_.run_within([&] { precondition(r, z); });
      },
      right, solution, enough, scale, most_steps, scalar_product, correct);
}

GradientsReport BoxSolver::search(std::span<const double> right, std::span<double> solution,
                                  double enough, double scale, int most_steps) {
  if (team_) return team_->search(right, solution, enough, scale, most_steps);
  if (packed_) {
    const GradientsReport report = search_packed(right, solution, enough, scale, most_steps);
    if (report.converged) return report;
    packed_.reset();
    single_.reset();
    std::ranges::fill(solution, 0.0);
  }
  return search_by(&BoxSolver::multiply, right, solution, enough, scale, most_steps);
}

/// Steps with bonds in single precision, residuals by the network.
GradientsReport BoxSolver::search_packed(std::span<const double> right, std::span<double> solution,
                                         double enough, double scale, int most_steps) {
  packed_->follow(secants_);
  const auto correct = [&](std::span<const double> found, std::span<double> residual) {
    multiply(found, residual);
    for (std::size_t k = 0; k < residual.size(); ++k) residual[k] = right[k] - residual[k];
  };
  try {
    return search_by(&BoxSolver::multiply_packed, right, solution, enough, scale, most_steps,
                     correct);
  } catch (const NotPositiveDefinite&) {
    return {};  // double precision has the last word
  }
}

void BoxSolver::precondition(std::span<const double> residual, std::span<double> result) {
  const int width = unknowns_.width;
#pragma omp parallel for schedule(static) if (network_.particles.size() > many_particles)
  for (Index p = 0; p < network_.particles.size(); ++p) {
    const double* block = blocks_.data() + static_cast<std::size_t>(p) * width * width;
    for (int a = 0; a < width; ++a) {
      if (unknowns_.at(p, a) < 0) continue;
      double sum = 0.0;
      for (int b = 0; b < width; ++b) {
        if (unknowns_.at(p, b) >= 0) sum += block[a * width + b] * residual[unknowns_.at(p, b)];
      }
      result[unknowns_.at(p, a)] = sum;
    }
  }
  motions_->restrict(residual, coarse_);
  factor_->solve(coarse_, coarse_);
  motions_->add(coarse_, result);
}

/// result = K q
void BoxSolver::multiply(std::span<const double> q, std::span<double> result) {
  const std::vector<Index>& number = unknowns_.number;
  for (std::size_t slot = 0; slot < number.size(); ++slot) {
    if (number[slot] >= 0) motion_[slot] = q[number[slot]];
  }
  internal_force(network_, secants_, motion_, forces_);
  for (std::size_t slot = 0; slot < number.size(); ++slot) {
    if (number[slot] >= 0) result[number[slot]] = forces_.forces[slot];
  }
  if (ground_ == nullptr) return;
  for (std::size_t k = 0; k < ground_->size(); ++k) result[k] += (*ground_)[k] * q[k];
}

/// The same by packed bonds.
void BoxSolver::multiply_packed(std::span<const double> q, std::span<double> result) {
  const auto width = static_cast<std::size_t>(unknowns_.width);
  const std::size_t row = PackedBonds::row_size(unknowns_.width);
  const auto for_each_unknown = [&](auto visit) {
    for (Index p = 0; p < network_.particles.size(); ++p) {
      const std::size_t slot = p * width, place = packed_->place(p) * row;
      for (std::size_t a = 0; a < width; ++a) {
        const Index unknown = unknowns_.number[slot + a];
        if (unknown >= 0) visit(slot + a, place + a, unknown);
      }
    }
  };
  for_each_unknown([&](std::size_t, std::size_t place, Index k) { packed_motion_[place] = q[k]; });
  packed_->forces(packed_motion_, packed_forces_);
  for_each_unknown([&](std::size_t slot, std::size_t place, Index k) {
    result[k] = packed_->unit() * packed_forces_[place];
    if (!network_.support_stiffness.empty()) result[k] += network_.support_stiffness[slot] * q[k];
    if (ground_ != nullptr && !ground_->empty()) result[k] += (*ground_)[k] * q[k];
  });
}

void BoxSolver::solve(std::span<const double> right, std::span<double> solution) {
  const std::vector<double> wanted(right.begin(), right.end());
  std::fill(solution.begin(), solution.end(), 0.0);
  const double tolerance = options_.tolerance * (options_.blocks ? finer : 1.0);
  const GradientsReport report =
      search(wanted, solution, tolerance, options_.blocks ? 0.0 : energy_, most_box_iterations);
  iterations_ += report.iterations;
  energy_ = options_.blocks ? report.energy : std::max(energy_, report.energy);
  error_ = energy_ > 0.0 ? report.error / std::sqrt(energy_) : 0.0;
  if (!report.converged) throw not_there(report.iterations, error_, tolerance);
}

void BoxSolver::correct(std::span<const double> right, std::span<double> solution, double energy) {
  const double tolerance = options_.tolerance * finer;
  const std::vector<double> wanted(right.begin(), right.end());
  std::ranges::fill(solution, 0.0);
  const GradientsReport report = search(wanted, solution, tolerance, energy, most_box_iterations);
  iterations_ += report.iterations;
  if (!report.converged) throw not_there(report.iterations, report.error, tolerance);
}

void BoxSolver::precondition_block(std::span<const double> residuals, std::span<double> results) {
  const int width = unknowns_.width;
  const double* block = blocks_.data();
  const std::size_t size = static_cast<std::size_t>(width) * block_width;
  for (std::size_t begin = 0; begin < residuals.size(); begin += size, block += width * width) {
    for (int a = 0; a < width; ++a) {
      std::array<double, block_width> sums{};
      for (int b = 0; b < width; ++b) {
        const double* residual = residuals.data() + begin + b * block_width;
        for (int k = 0; k < block_width; ++k) sums[k] += block[a * width + b] * residual[k];
      }
      std::copy(sums.begin(), sums.end(), results.data() + begin + a * block_width);
    }
  }
  motions_->restrict_block(residuals, coarse_block_);
  factor_->solve_all(coarse_block_);
  motions_->add_block(coarse_block_, results);
}

void BoxSolver::multiply_block(std::span<const double> motions, std::span<double> results) {
  block_forces(network_, secants_, motions, results);
  const std::vector<Index>& number = unknowns_.number;
  for (std::size_t slot = 0; slot < number.size(); ++slot) {
    double* result = results.data() + slot * block_width;
    if (number[slot] < 0) {
      std::fill_n(result, block_width, 0.0);
    } else if (ground_ != nullptr && !ground_->empty()) {
      const double* motion = motions.data() + slot * block_width;
      for (int k = 0; k < block_width; ++k) result[k] += (*ground_)[number[slot]] * motion[k];
    }
  }
}

GradientsReport BoxSolver::search_block(std::span<double> right, std::span<double> solution,
                                        const BlockRow& sizes, double enough) {
  if (team_) return team_->search_block(right, solution, sizes, enough, most_box_iterations);
  GradientsReport report;
  if (is_found_in_single(right, solution, sizes, enough, report)) return report;
  coarse_block_.resize(coarse_.size() * block_width);
  if (SingleBody::is_made_of(network_)) enough *= finer_of_trusses;
  block_threads_.run_within([&] {
    report = block_conjugate_gradients<double>(
        as_block_map<double>([&](auto q, auto result) { multiply_block(q, result); }),
        as_block_map<double>([&](auto r, auto z) { precondition_block(r, z); }), right, solution,
        sizes, enough, most_box_iterations);
  });
  return report;
}

/// Bodies that are stiff and soft by turns, or slender, may ask for more digits than single
/// precision has: then blocks are left to double precision until boxes are made anew.
bool BoxSolver::is_found_in_single(std::span<const double> right, std::span<double> solution,
                                   const BlockRow& sizes, double enough, GradientsReport& report) {
  if (!single_) return false;
  try {
    report = search_in_single(right, solution, sizes, enough);
  } catch (const NotPositiveDefinite&) {
    report.converged = false;  // double precision has the last word
  }
  if (!report.converged) single_.reset();
  return report.converged;
}

GradientsReport BoxSolver::solve_block(std::span<double> right, std::span<double> solution,
                                       double enough, double energy_of_last) {
  BlockRow sizes = local_energies(blocks_, unknowns_.width, right);
  if (energy_of_last > 0.0) {
    const double finer_than_others = options_.tolerance * finer / enough;
    sizes.back() = energy_of_last * finer_than_others * finer_than_others;
  }
  const GradientsReport report = search_block(right, solution, sizes, enough);
  iterations_ += report.iterations;
  if (!report.converged) throw not_there(report.iterations, report.error, enough);
  return report;
}

/// Steps in single precision; what they have found is added up in double precision, and so is what
/// is left. Right sides count by the root of their local energies, so that none is too small.
GradientsReport BoxSolver::search_in_single(std::span<const double> right,
                                            std::span<double> solution, const BlockRow& sizes,
                                            double enough) {
  single_->follow(secants_, ground_ == nullptr ? std::span<const double>() : *ground_);
  const std::size_t row = static_cast<std::size_t>(unknowns_.width) * block_width;
  const double root = std::sqrt(packed_->unit());
  const BlockRow local = local_energies(blocks_, unknowns_.width, right);
  BlockRow scaled{}, unit;  // sizes, and what a right side and its solution are divided by
  for (int c = 0; c < block_width; ++c) {
    unit[c] = local[c] > 0.0 ? std::sqrt(local[c]) : 1.0;
    scaled[c] = sizes[c] / (unit[c] * unit[c]);
  }
  BlockVector<float> found(right.size()), missing(right.size());
  const auto for_each_particle = [&](auto visit) {
#pragma omp parallel for schedule(static) if (network_.particles.size() > many_particles)
    for (Index p = 0; p < network_.particles.size(); ++p) {
      visit(static_cast<std::size_t>(p) * row, packed_->place(p) * row);
    }
  };
  const auto add = [&](std::span<const float> part) {
    for_each_particle([&](std::size_t to, std::size_t from) {
      for (std::size_t k = 0; k < row; ++k) {
        solution[to + k] += part[from + k] / root * unit[k % block_width];
      }
    });
  };
  const auto round = [&](std::span<const double> whole, std::span<float> rounded) {
    for_each_particle([&](std::size_t from, std::size_t to) {
      for (std::size_t k = 0; k < row; ++k) {
        rounded[to + k] = static_cast<float>(whole[from + k] / (root * unit[k % block_width]));
      }
    });
  };
  std::ranges::fill(solution, 0.0);
  round(right, missing);
  const auto correct = [&](std::span<const float> part, std::span<float> left) {
    add(part);
    BlockVector<double> residual(right.size());
    multiply_block(solution, residual);
    for (std::size_t k = 0; k < right.size(); ++k) residual[k] = right[k] - residual[k];
    round(residual, left);
  };
  GradientsReport report;
  block_threads_.run_within([&] {
    report = block_conjugate_gradients<float>(
        [&](auto q, auto result, const RowsDone& done) { single_->multiply(q, result, done); },
        [&](auto r, auto z, const RowsDone& done) { single_->precondition(r, z, done); }, missing,
        found, scaled, finer_of_trusses * enough, most_box_iterations, correct);
  });
  add(found);
  return report;
}

}  // namespace perilink
