#include "analysis/dynamics/subdomain_preconditioner.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "base/csr.hpp"
#include "network/frame.hpp"

namespace perilink {
namespace {

using Eigen::VectorXd;

/// unknowns; a dense matrix of this size costs less than the iteration
constexpr int most_coarse = 600;
/// Pivots below this fraction of the diagonal are round-off.
constexpr double floor_of_pivots = 1e-13;

template <int Dim, class Visit>
void visit_modes(const Network& network, Index element, std::array<EnergyPart, 2>& ends,
                 Visit& visit) {
  const FrameModes<Dim> modes = frame_modes<Dim>(network, element);
  for (int m = 0; m < FrameModes<Dim>::count; ++m) {
    std::copy(modes.first[m].begin(), modes.first[m].end(), ends[0].b.begin());
    std::copy(modes.second[m].begin(), modes.second[m].end(), ends[1].b.begin());
    visit(modes.stiffness[m], std::span<const EnergyPart>(ends));
  }
}

/// Calls visit(k, parts) for the squares of bonds and springs.
template <class Visit>
void visit_elements(const Network& network, Visit visit) {
  const int dim = network.dim(), width = network.width();
  for (Index e = 0; e < network.num_elements(); ++e) {
    std::array<EnergyPart, 2> ends{EnergyPart{network.bonds.first[e], {}},
                                   EnergyPart{network.bonds.second[e], {}}};
    if (network.carries_moments()) {
      dim == 2 ? visit_modes<2>(network, e, ends, visit) : visit_modes<3>(network, e, ends, visit);
      continue;
    }
    for (int a = 0; a < dim; ++a) {
      ends[1].b[a] = network.bonds.direction(e)[a];
      ends[0].b[a] = -ends[1].b[a];
    }
    visit(network.stiffness[e], std::span<const EnergyPart>(ends));
  }
  for (std::size_t slot = 0; slot < network.support_stiffness.size(); ++slot) {
    if (network.support_stiffness[slot] == 0.0) continue;
    EnergyPart part{static_cast<Index>(slot / width), {}};
    part.b[slot % width] = 1.0;
    visit(network.support_stiffness[slot], std::span<const EnergyPart>(&part, 1));
  }
}

/// Calls visit(k, parts) for the squares of sums of extensions.
template <class Visit>
void visit_states(const Network& network, Visit visit) {
  if (!network.has_states()) return;
  const Csr around = bonds_of_particles(network.bonds, network.particles.size());
  std::vector<EnergyPart> parts;
  for (Index i = 0; i < network.particles.size(); ++i) {
    parts.assign(1, {i, {}});
    for (const Index e : around.row(i)) {
      const bool outward = network.bonds.first[e] == i;
      if (!network.counts_for(e, outward ? first_end : second_end)) continue;
      EnergyPart far{outward ? network.bonds.second[e] : network.bonds.first[e], {}};
      for (int a = 0; a < network.dim(); ++a) {
        far.b[a] = (outward ? 1.0 : -1.0) * network.bonds.direction(e)[a];
        parts[0].b[a] -= far.b[a];
      }
      parts.push_back(far);
    }
    visit(network.states->stiffness[i], std::span<const EnergyPart>(parts));
  }
}

}  // namespace

SubdomainPreconditioner::SubdomainPreconditioner(const Network& network, const Unknowns& unknowns)
    : dim_(network.dim()),
      width_(network.width()),
      modes_(dim_ == 2 ? 3 : 6),
      number_(unknowns.number) {
  number_subdomains(network.particles);
  set_arms(network.particles);
  const std::size_t count = network.particles.size();
  blocks_.assign(count * width_ * width_, 0.0);
  coarse_.setZero(subdomains_ * modes_, subdomains_ * modes_);
  const auto take = [this](double k, std::span<const EnergyPart> parts) { add(k, parts); };
  visit_elements(network, take);
  visit_states(network, take);
  for (Eigen::Index k = 0; k < coarse_.rows(); ++k) {
    coarse_(k, k) += coarse_(k, k) > 0.0 ? floor_of_pivots * coarse_(k, k) : 1.0;
  }
  inverse_.compute(coarse_);  // reads the lower triangle
  coarse_.resize(0, 0);
  invert_blocks();
}

/// Divides the body into as many cubes as the size of the dense matrix allows.
void SubdomainPreconditioner::number_subdomains(const Particles& particles) {
  const Index count = particles.size();
  Vector3 lower{}, upper{};
  double longest = 0.0;
  for (int a = 0; a < dim_; ++a) {
    lower[a] = upper[a] = particles.position(0)[a];
    for (Index i = 0; i < count; ++i) {
      lower[a] = std::min(lower[a], particles.position(i)[a]);
      upper[a] = std::max(upper[a], particles.position(i)[a]);
    }
    longest = std::max(longest, upper[a] - lower[a]);
  }
  longest = std::max(longest, std::numeric_limits<double>::min());
  constexpr double finer = 1.3, finest = 1e6;
  for (double along = 1.0; along < finest && subdomains_ < count; along *= finer) {
    const double side = longest / along * (1.0 + 1e-9);
    std::map<std::array<Index, 3>, Index> numbers;
    std::vector<Index> subdomain_of;
    for (Index i = 0; i < count && static_cast<int>(numbers.size()) * modes_ <= most_coarse; ++i) {
      std::array<Index, 3> subdomain{};
      for (int a = 0; a < dim_; ++a) {
        subdomain[a] = static_cast<Index>((particles.position(i)[a] - lower[a]) / side);
      }
      subdomain_of.push_back(
          numbers.emplace(subdomain, static_cast<Index>(numbers.size())).first->second);
    }
    if (static_cast<int>(numbers.size()) * modes_ > most_coarse) return;
    subdomains_ = static_cast<Index>(numbers.size());
    side_ = side;
    subdomain_of_ = std::move(subdomain_of);
  }
}

void SubdomainPreconditioner::set_arms(const Particles& particles) {
  std::vector<double> middle(static_cast<std::size_t>(subdomains_) * dim_, 0.0),
      count(subdomains_, 0.0);
  for (Index i = 0; i < particles.size(); ++i) {
    count[subdomain_of_[i]] += 1.0;
    for (int a = 0; a < dim_; ++a) middle[subdomain_of_[i] * dim_ + a] += particles.position(i)[a];
  }
  for (Index i = 0; i < particles.size(); ++i) {
    for (int a = 0; a < dim_; ++a) {
      const double center = middle[subdomain_of_[i] * dim_ + a] / count[subdomain_of_[i]];
      arm_.push_back((particles.position(i)[a] - center) / side_);
    }
  }
}

/// Returns a force (and moment) on a particle as force and moment on its subdomain; moments are
/// over the edge length.
SubdomainPreconditioner::Motion SubdomainPreconditioner::on_subdomain(Index particle,
                                                                      const double* b) const {
  const double* r = arm_.data() + static_cast<std::size_t>(particle) * dim_;
  Motion result{};
  std::copy_n(b, dim_, result.begin());
  if (dim_ == 2) {
    result[2] = r[0] * b[1] - r[1] * b[0];
  } else {
    for (int a = 0; a < 3; ++a) {
      const int c = (a + 1) % 3, d = (a + 2) % 3;
      result[3 + a] = r[c] * b[d] - r[d] * b[c];
    }
  }
  for (int m = dim_; m < width_; ++m) result[m] += b[m] / side_;
  return result;
}

void SubdomainPreconditioner::add(double stiffness, std::span<const EnergyPart> parts) {
  on_subdomains_.clear();
  for (const EnergyPart& part : parts) {
    Motion b = part.b;
    const std::size_t slot = static_cast<std::size_t>(part.particle) * width_;
    double* block = blocks_.data() + slot * width_;
    for (int r = 0; r < width_; ++r) {
      if (number_[slot + r] == no_index) b[r] = 0.0;
    }
    for (int r = 0; r < width_; ++r) {
      for (int c = 0; c < width_; ++c) block[r * width_ + c] += stiffness * b[r] * b[c];
    }
    const Motion own = on_subdomain(part.particle, b.data());
    const Index subdomain = subdomain_of_[part.particle];
    const auto same = std::find_if(on_subdomains_.begin(), on_subdomains_.end(),
                                   [&](const auto& each) { return each.first == subdomain; });
    if (same == on_subdomains_.end()) {
      on_subdomains_.emplace_back(subdomain, own);
      continue;
    }
    for (int m = 0; m < modes_; ++m) same->second[m] += own[m];
  }
  for (const auto& [row, left] : on_subdomains_) {
    for (const auto& [column, right] : on_subdomains_) {
      if (row < column) continue;
      for (int c = 0; c < modes_; ++c) {
        for (int r = 0; r < modes_; ++r) {
          coarse_(row * modes_ + r, column * modes_ + c) += stiffness * left[r] * right[c];
        }
      }
    }
  }
}

void SubdomainPreconditioner::invert_blocks() {
  for (std::size_t at = 0; at < blocks_.size(); at += static_cast<std::size_t>(width_) * width_) {
    Eigen::Map<Eigen::MatrixXd> block(blocks_.data() + at, width_, width_);
    for (int c = 0; c < width_; ++c) {
      diagonal_.push_back(block(c, c));
      block(c, c) += block(c, c) > 0.0 ? floor_of_pivots * block.trace() : 1.0;
    }
    block = Eigen::MatrixXd(block.ldlt().solve(Eigen::MatrixXd::Identity(width_, width_)));
  }
}

/// Returns the motion of a particle in a rigid motion of its subdomain; the transpose of
/// on_subdomain().
SubdomainPreconditioner::Motion SubdomainPreconditioner::of_subdomain(
    Index particle, const double* subdomain) const {
  const double* r = arm_.data() + static_cast<std::size_t>(particle) * dim_;
  Motion result{};
  if (dim_ == 2) {
    result = {subdomain[0] - subdomain[2] * r[1], subdomain[1] + subdomain[2] * r[0]};
  } else {
    for (int a = 0; a < 3; ++a) {
      const int c = (a + 1) % 3, d = (a + 2) % 3;
      result[a] = subdomain[a] + subdomain[3 + c] * r[d] - subdomain[3 + d] * r[c];
    }
  }
  for (int m = dim_; m < width_; ++m) result[m] = subdomain[m] / side_;
  return result;
}

VectorXd SubdomainPreconditioner::times(const VectorXd& residual) const {
  VectorXd coarse = VectorXd::Zero(subdomains_ * modes_), result(residual.size());
  const auto count = static_cast<Index>(subdomain_of_.size());
  for (Index i = 0; i < count; ++i) {
    const Motion own = on_subdomain(i, residual.data() + std::ptrdiff_t{i} * width_);
    for (int m = 0; m < modes_; ++m) coarse[subdomain_of_[i] * modes_ + m] += own[m];
  }
  coarse = inverse_.solve(coarse).eval();
  for (Index i = 0; i < count; ++i) {
    const std::ptrdiff_t slot = std::ptrdiff_t{i} * width_;
    const double* block = blocks_.data() + slot * width_;
    const Motion moved = of_subdomain(i, coarse.data() + subdomain_of_[i] * modes_);
    for (int r = 0; r < width_; ++r) {
      double sum = moved[r];
      for (int c = 0; c < width_; ++c) sum += block[r * width_ + c] * residual[slot + c];
      result[slot + r] = number_[slot + r] == no_index ? 0.0 : sum;
    }
  }
  return result;
}

double SubdomainPreconditioner::fastest(const std::vector<double>& mass) const {
  double largest = 0.0;
  for (std::size_t slot = 0; slot < mass.size(); ++slot) {
    largest = std::max(largest, diagonal_[slot] / mass[slot]);
  }
  return largest;
}

}  // namespace perilink
