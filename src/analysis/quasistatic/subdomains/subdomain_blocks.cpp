#include <algorithm>
#include <array>
#include <cmath>

#include "analysis/quasistatic/subdomains/subdomain_solver.hpp"
#include "assembly/block_forces.hpp"
#include "solver/not_positive_definite.hpp"

/// \file
/// SubdomainSolver for blocks of vectors.

namespace perilink {
namespace {

/// Factor by which trusses tighten the tolerance. Error estimates lag (L-2), so that solutions have
/// more digits than requested, and columns need some of them. Behind a correction in single
/// precision estimates lag less, and bodies beyond single precision need more digits.
constexpr double finer_of_trusses = 0.1;

/// Returns the energies of right sides if each particle moves by itself and all others are fixed.
/// \param blocks  inverse stiffness of the particles
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

}  // namespace

void SubdomainSolver::precondition_block(std::span<const double> residuals,
                                         std::span<double> results) {
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
  motions_.restrict_block(residuals, coarse_block_);
  factor_->solve_all(coarse_block_);
  motions_.add_block(coarse_block_, results);
}

void SubdomainSolver::multiply_block(std::span<const double> motions, std::span<double> results) {
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

GradientsReport SubdomainSolver::search_block(std::span<double> right, std::span<double> solution,
                                              const BlockRow& sizes, double enough) {
  if (team_) return team_->search_block(right, solution, sizes, enough, most_iterations);
  GradientsReport report;
  if (is_found_in_single(right, solution, sizes, enough, report)) return report;
  coarse_block_.resize(coarse_.size() * block_width);
  if (SingleBody::is_made_of(network_)) enough *= finer_of_trusses;
  block_threads_.run_within([&] {
    report = block_conjugate_gradients<double>(
        as_block_map<double>([&](auto q, auto result) { multiply_block(q, result); }),
        as_block_map<double>([&](auto r, auto z) { precondition_block(r, z); }), right, solution,
        sizes, enough, most_iterations);
  });
  return report;
}

/// Solves in single precision. If its digits do not suffice, for slender bodies or those with stiff
/// and soft parts, double precision solves blocks until subdomains are made anew.
/// \return whether single precision converged
bool SubdomainSolver::is_found_in_single(std::span<const double> right, std::span<double> solution,
                                         const BlockRow& sizes, double enough,
                                         GradientsReport& report) {
  if (!single_) return false;
  try {
    report = search_in_single(right, solution, sizes, enough);
  } catch (const NotPositiveDefinite&) {
    report.converged = false;  // double precision decides
  }
  if (!report.converged) single_.reset();
  return report.converged;
}

GradientsReport SubdomainSolver::solve_block(std::span<double> right, std::span<double> solution,
                                             double enough) {
  const BlockRow sizes = local_energies(blocks_, unknowns_.width, right);
  const GradientsReport report = search_block(right, solution, sizes, enough);
  iterations_ += report.iterations;
  if (!report.converged) throw not_there(report.iterations, report.error, enough);
  return report;
}

/// Iterates in single precision, and sums solutions and residuals in double precision. Right sides
/// are scaled by the root of their local energies, so that none is too small.
GradientsReport SubdomainSolver::search_in_single(std::span<const double> right,
                                                  std::span<double> solution, const BlockRow& sizes,
                                                  double enough) {
  single_->follow(secants_, ground_ == nullptr ? std::span<const double>() : *ground_);
  const std::size_t row = static_cast<std::size_t>(unknowns_.width) * block_width;
  const double root = std::sqrt(packed_->unit());
  const BlockRow local = local_energies(blocks_, unknowns_.width, right);
  BlockRow scaled{}, unit;  // scaled sizes, and divisors of right sides and solutions
  for (int c = 0; c < block_width; ++c) {
    unit[c] = local[c] > 0.0 ? std::sqrt(local[c]) : 1.0;
    scaled[c] = sizes[c] / (unit[c] * unit[c]);
  }
  auto& [found, missing, residual, space] = single_space_;
  for (BlockVector<float>* vectors : {&found, &missing}) vectors->resize(right.size());
  residual.resize(right.size());
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
    multiply_block(solution, residual);
    for (std::size_t k = 0; k < right.size(); ++k) residual[k] = right[k] - residual[k];
    round(residual, left);
  };
  GradientsReport report;
  block_threads_.run_within([&] {
    report = block_conjugate_gradients<float>(
        [&](auto q, auto result, const RowsDone& done) { single_->multiply(q, result, done); },
        [&](auto r, auto z, const RowsDone& done) { single_->precondition(r, z, done); }, missing,
        found, scaled, finer_of_trusses * enough, most_iterations, correct, {}, &space);
  });
  add(found);
  return report;
}

}  // namespace perilink
