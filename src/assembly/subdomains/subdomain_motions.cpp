#include "assembly/subdomains/subdomain_motions.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/block.hpp"
#include "base/joined_parts.hpp"
#include "discretization/point_boxes.hpp"

namespace perilink {
namespace {

/// Returns the subdomain of each particle, or no_index without one.
std::vector<Index> numbers_of_subdomains(const std::vector<std::vector<Index>>& subdomains,
                                         Index particles) {
  std::vector<Index> subdomain_of(static_cast<std::size_t>(particles), no_index);
  for (std::size_t b = 0; b < subdomains.size(); ++b) {
    for (const Index p : subdomains[b]) subdomain_of[p] = static_cast<Index>(b);
  }
  return subdomain_of;
}

/// Fewer subdomains take less time than starting the threads.
constexpr Index subdomains_for_threads = 100;

}  // namespace

std::vector<std::vector<Index>> split_by_cracks(const std::vector<std::vector<Index>>& subdomains,
                                                const Network& network, Secants secants) {
  const std::vector<Index> subdomain_of =
      numbers_of_subdomains(subdomains, network.particles.size());
  JoinedParts parts(network.particles.size());
  const auto join = [&](Index i, Index j) {
    if (subdomain_of[i] == subdomain_of[j]) parts.join(i, j);
  };
  for (Index e = 0; e < network.num_elements(); ++e) {
    if (network.stiffness[e] * secants.axial(e) > 0.0) {
      join(network.bonds.first[e], network.bonds.second[e]);
    }
  }
  if (network.cells) {
    for (Index c = 0; c < network.cells->cells.size(); ++c) {
      const auto cell = network.cells->cells.cell(c);
      for (const Index p : cell) join(cell[0], p);
    }
  }
  return split_unjoined(subdomains, parts);
}

SubdomainMotions::SubdomainMotions(const Network& network, Secants secants,
                                   const Unknowns& unknowns, Index most)
    : dim_(network.dim()),
      unknowns_(unknowns),
      subdomains_(split_by_cracks(
          split_into_boxes(network.particles.positions, network.dim(), most), network, secants)),
      subdomain_of_(numbers_of_subdomains(subdomains_, network.particles.size())) {
  find_centres(network.particles);
}

void SubdomainMotions::find_centres(const Particles& particles) {
  const std::size_t dim = static_cast<std::size_t>(dim_);
  arms_ = particles.positions;
  for (const std::vector<Index>& subdomain : subdomains_) {
    for (std::size_t a = 0; a < dim; ++a) {
      double centre = 0.0;
      for (const Index p : subdomain) centre += arms_[p * dim + a];
      centre /= static_cast<double>(subdomain.size());
      for (const Index p : subdomain) arms_[p * dim + a] -= centre;
    }
    double square = 0.0;
    for (const Index p : subdomain) {
      for (std::size_t a = 0; a < dim; ++a) square += arms_[p * dim + a] * arms_[p * dim + a];
    }
    // A single particle turns only where its bonds carry moments; any length works.
    const double size =
        square > 0.0 ? std::sqrt(square / static_cast<double>(subdomain.size())) : 1.0;
    for (const Index p : subdomain) {
      for (std::size_t a = 0; a < dim; ++a) arms_[p * dim + a] /= size;
    }
    size_.push_back(size);
  }
}

/// Calls visit(component, motion, share) for the free components of a particle and the rigid
/// motions of its subdomain.
template <class Visit>
void SubdomainMotions::for_each_move(Index particle, Visit visit) const {
  const double* arm = arms_.data() + static_cast<std::size_t>(particle) * dim_;
  for (int c = 0; c < unknowns_.width; ++c) {
    if (unknowns_.at(particle, c) < 0) continue;
    if (c >= dim_) {
      visit(c, c, 1.0 / size_[subdomain_of_[particle]]);
      continue;
    }
    visit(c, c, 1.0);
    if (dim_ == 2) {
      visit(c, 2, c == 0 ? -arm[1] : arm[0]);
    } else {  // rotation x arm
      const int next = (c + 1) % 3, last = (c + 2) % 3;
      visit(c, 3 + next, arm[last]);
      visit(c, 3 + last, -arm[next]);
    }
  }
}

std::array<double, 6> SubdomainMotions::row(Index particle, int component) const {
  std::array<double, 6> row{};
  for_each_move(particle, [&](int c, int motion, double share) {
    if (c == component) row[motion] = share;
  });
  return row;
}

/// Adds a particle's forces and moments to the sums of its subdomain; components that are held have
/// zero force.
template <int Dim>
void SubdomainMotions::add_to_sums(Index particle, const double* force, double* sums) const {
  const double* arm = arms_.data() + static_cast<std::size_t>(particle) * Dim;
  for (int a = 0; a < Dim; ++a) sums[a] += force[a];
  if constexpr (Dim == 2) {
    sums[2] += arm[0] * force[1] - arm[1] * force[0];
  } else {
    for (int a = 0; a < 3; ++a) {
      const int b = (a + 1) % 3, c = (a + 2) % 3;
      sums[3 + a] += arm[b] * force[c] - arm[c] * force[b];
    }
  }
  for (int a = Dim; a < unknowns_.width; ++a) sums[a] += force[a] / size_[subdomain_of_[particle]];
}

/// Computes the components of a particle from the rigid motion of its subdomain.
template <int Dim>
void SubdomainMotions::find_motion(Index particle, const double* values, double* motion) const {
  const double* arm = arms_.data() + static_cast<std::size_t>(particle) * Dim;
  if constexpr (Dim == 2) {
    motion[0] = values[0] - arm[1] * values[2];
    motion[1] = values[1] + arm[0] * values[2];
  } else {
    for (int a = 0; a < 3; ++a) {  // rotation x arm
      const int b = (a + 1) % 3, c = (a + 2) % 3;
      motion[a] = values[a] + (values[3 + b] * arm[c] - values[3 + c] * arm[b]);
    }
  }
  for (int a = Dim; a < unknowns_.width; ++a)
    motion[a] = values[a] / size_[subdomain_of_[particle]];
}

void SubdomainMotions::restrict(std::span<const double> residual, std::span<double> coarse) const {
  const int motions = num_motions(), width = unknowns_.width;
#pragma omp parallel for schedule(static) if (num_subdomains() > subdomains_for_threads)
  for (Index b = 0; b < num_subdomains(); ++b) {
    std::array<double, 6> sums{}, force{};
    for (const Index p : subdomains_[b]) {
      for (int c = 0; c < width; ++c) {
        force[c] = unknowns_.at(p, c) < 0 ? 0.0 : residual[unknowns_.at(p, c)];
      }
      dim_ == 2 ? add_to_sums<2>(p, force.data(), sums.data())
                : add_to_sums<3>(p, force.data(), sums.data());
    }
    std::copy_n(sums.begin(), motions, coarse.begin() + static_cast<std::ptrdiff_t>(b) * motions);
  }
}

void SubdomainMotions::add(std::span<const double> coarse, std::span<double> result) const {
  const int motions = num_motions(), width = unknowns_.width;
#pragma omp parallel for schedule(static) if (num_subdomains() > subdomains_for_threads)
  for (Index b = 0; b < num_subdomains(); ++b) {
    const double* values = coarse.data() + static_cast<std::size_t>(b) * motions;
    std::array<double, 6> motion;
    for (const Index p : subdomains_[b]) {
      dim_ == 2 ? find_motion<2>(p, values, motion.data())
                : find_motion<3>(p, values, motion.data());
      for (int c = 0; c < width; ++c) {
        if (unknowns_.at(p, c) >= 0) result[unknowns_.at(p, c)] += motion[c];
      }
    }
  }
}

void SubdomainMotions::restrict_block(std::span<const double> residuals,
                                      std::span<double> coarse) const {
  const int motions = num_motions(), width = unknowns_.width;
  const std::size_t size = coarse.size() / block_width;
  for (Index b = 0; b < num_subdomains(); ++b) {
    std::array<std::array<double, block_width>, 6> sums{};
    for (const Index p : subdomains_[b]) {
      const double* residual = residuals.data() + static_cast<std::size_t>(p) * width * block_width;
      for_each_move(p, [&](int c, int m, double share) {
        for (int k = 0; k < block_width; ++k) sums[m][k] += share * residual[c * block_width + k];
      });
    }
    double* to = coarse.data() + static_cast<std::size_t>(b) * motions;
    for (int k = 0; k < block_width; ++k) {
      for (int m = 0; m < motions; ++m) to[k * size + m] = sums[m][k];
    }
  }
}

void SubdomainMotions::add_block(std::span<const double> coarse, std::span<double> results) const {
  const int motions = num_motions(), width = unknowns_.width;
  const std::size_t size = coarse.size() / block_width;
  for (Index b = 0; b < num_subdomains(); ++b) {
    std::array<std::array<double, block_width>, 6> values{};
    const double* from = coarse.data() + static_cast<std::size_t>(b) * motions;
    for (int k = 0; k < block_width; ++k) {
      for (int m = 0; m < motions; ++m) values[m][k] = from[k * size + m];
    }
    for (const Index p : subdomains_[b]) {
      double* result = results.data() + static_cast<std::size_t>(p) * width * block_width;
      for_each_move(p, [&](int c, int m, double share) {
        for (int k = 0; k < block_width; ++k) result[c * block_width + k] += share * values[m][k];
      });
    }
  }
}

}  // namespace perilink
